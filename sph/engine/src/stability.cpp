// The stability limit of the leap-frog, measured on the very arrangement: 2/omega with omega the largest frequency of
// the elastic body, by power iteration with the inner loops themselves. Eq 32 knows neither irregular particle
// distances nor the large corrections at edges, which can shorten the limit several times.
#include <algorithm>
#include <cmath>
#include <random>

#include "chunks.hpp"
#include "engine.hpp"
#include "fpz/sph/archive.hpp"

namespace fpz::sph {

namespace detail {

template <int Dim>
void Engine<Dim>::accelerate_from_rest() {
  Particles<Dim>& p = run.particles;
  View<Dim> v = run.view;
  v.step = 1.0;
  v.damped = false;
  v.pushed = false;
  for (std::size_t c = 0; c < run.dimensions; ++c) v.gravity[c] = 0.0;
  for (Field& g : p.gradient) std::fill(g.begin(), g.end(), 0.0);
  if (control) control->forget_displacements();
  run.for_chunks([&](Index first, Index last) { run.passes->strain_reference(v, first, last); });
  run.for_chunks([&](Index first, Index last) { run.passes->force_reference(v, first, last); });
}

template <int Dim>
double Engine<Dim>::largest_frequency() {
  constexpr int iterations = 400;
  constexpr double settled = 1e-4;  // relative change per iteration; the estimate rises monotonically
  constexpr double strain = 1e-6;   // small against one: the polar decomposition is linear there
  Particles<Dim>& p = run.particles;
  const double amplitude = strain * run.setup.arrangement.spacing;
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Field& u : p.velocity) {
    for (std::size_t i = 0; i < p.count; ++i) u[i] = amplitude * uniform(rng);
  }
  double square = 0.0;
  for (int k = 0; k < iterations; ++k) {
    for (const auto& boundary : boundaries) boundary->hold();
    const Fields<Dim> before = p.velocity;
    accelerate_from_rest();
    double kinetic_norm = 0.0;
    double elastic_norm = 0.0;
    double largest = 0.0;
    for (std::size_t c = 0; c < run.dimensions; ++c) {
      for (std::size_t i = 0; i < p.count; ++i) {
        kinetic_norm += p.mass[i] * before[c][i] * before[c][i];
        elastic_norm -= p.mass[i] * before[c][i] * p.acceleration[c][i];
        largest = std::max(largest, std::abs(p.acceleration[c][i]));
      }
    }
    if (!(largest > 0.0)) break;
    const double last = square;
    square = elastic_norm / kinetic_norm;
    for (std::size_t c = 0; c < run.dimensions; ++c) {
      for (std::size_t i = 0; i < p.count; ++i) p.velocity[c][i] = p.acceleration[c][i] * (amplitude / largest);
    }
    if (k > 20 && std::abs(square - last) < settled * square) break;
  }
  return std::sqrt(std::max(square, 0.0));
}

template <int Dim>
double Engine<Dim>::stability_limit() {
  constexpr std::uint64_t own = 0;  // the bytes are for no one else
  Writer before(own);
  save(before);
  const std::vector<unsigned char> state = std::move(before).sealed();
  const double body_limit = 2.0 / largest_frequency();
  double limit = body_limit;
  // The stiffness of a boundary comes on top of the body's: squares of frequencies add up at most.
  for (const auto& boundary : boundaries) {
    const double ratio = body_limit / boundary->stable_step();
    limit = std::min(limit, body_limit / std::sqrt(1.0 + ratio * ratio));
  }
  Reader back(state, own);
  load(back);
  return limit;
}

template void Engine<2>::accelerate_from_rest();
template double Engine<2>::largest_frequency();
template double Engine<2>::stability_limit();

}  // namespace detail

template <int Dim>
double stability_limit(const RunSetup<Dim>& setup) {
  if (setup.options.configuration == Configuration::reference) {
    return detail::Engine<Dim>(setup, 1.0).stability_limit();
  }
  RunSetup<Dim> elastic = setup;  // the same operator while nothing has moved
  elastic.options.configuration = Configuration::reference;
  elastic.options.gradient = Gradient::kernel;
  elastic.options.zero_energy_control = 0.0;
  elastic.velocity.clear();
  return detail::Engine<Dim>(elastic, 1.0).stability_limit();
}

template double stability_limit<2>(const RunSetup<2>&);

}  // namespace fpz::sph
