#include "zero_energy_control.hpp"

#include <cmath>

#include "chunks.hpp"

namespace fpz::sph::detail {

template <int Dim>
ZeroEnergyControl<Dim>::ZeroEnergyControl(RunData<Dim>& run, const NeighbourLists& lists, double viscosity)
    : run_(run), rate_(rate_of(lists, viscosity)) {
  constexpr double longest = 16.0;  // rarely enough to cost little, often enough for a smooth motion
  interval_ = static_cast<int>(std::clamp(1.0 / (rate_ * run.dt), 1.0, longest));
  fields(*this, Allocate{run.particles.padded()});
  fields(*this, Point<Dim>{run.view});
  run.view.zero_energy_viscosity = interval_ * viscosity;
}

/// Pairwise dampers: no rate exceeds twice the largest sum of a particle's coefficients over its mass.
template <int Dim>
double ZeroEnergyControl<Dim>::rate_of(const NeighbourLists& lists, double viscosity) const {
  const Particles<Dim>& p = run_.particles;
  const double h = run_.h;
  double largest = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    double sum = 0.0;
    for (const int neighbour : lists[i]) {
      const auto j = static_cast<std::size_t>(neighbour);
      double square = 0.0;
      for (std::size_t c = 0; c < run_.dimensions; ++c)
        square += (p.start[c][j] - p.start[c][i]) * (p.start[c][j] - p.start[c][i]);
      const double slope = run_.view.slope_norm * kernel_slope(run_.setup.options.kernel, std::sqrt(square) / h);
      sum += slope * p.volume[i] * p.volume[j] * square / (square + 0.01 * h * h);
    }
    largest = std::max(largest, sum * p.inverse_mass[i]);
  }
  return 2.0 * viscosity * largest;
}

template <int Dim>
void ZeroEnergyControl<Dim>::act(const Boundaries<Dim>& boundaries) {
  Particles<Dim>& p = run_.particles;
  run_.for_chunks([&](Index first, Index last) {
    for (std::size_t c = 0; c < run_.dimensions; ++c) {
      for (std::size_t i = lanes_begin(first); i < lanes_begin(last); ++i) {
        p.predicted[c][i] = p.velocity[c][i] - 0.5 * run_.dt * p.acceleration[c][i];
      }
    }
  });
  for (const auto& boundary : boundaries) boundary->predict();
  run_.for_chunks([&](Index first, Index last) { run_.passes->gradient_zero_energy(run_.view, first, last); });
  run_.for_chunks([&](Index first, Index last) { run_.passes->force_zero_energy(run_.view, first, last); });
}

template <int Dim>
void ZeroEnergyControl<Dim>::account(bool acted) {
  double work = run_.ledger.zero_energy + next_;
  double next = 0.0;
  const Particles<Dim>& p = run_.particles;
  const double dt = run_.dt;
  for (std::size_t c = 0; acted && c < run_.dimensions; ++c) {
    for (std::size_t i = 0; i < p.count; ++i) {
      work -= 0.5 * dt * force_[c][i] * (p.velocity[c][i] - dt * p.acceleration[c][i]);
      next -= 0.5 * dt * force_[c][i] * p.velocity[c][i];
    }
  }
  run_.ledger.zero_energy = work;
  next_ = next;
}

template class ZeroEnergyControl<2>;

}  // namespace fpz::sph::detail
