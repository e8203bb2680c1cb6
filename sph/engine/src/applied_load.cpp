#include "applied_load.hpp"

namespace fpz::sph::detail {

template <int Dim>
AppliedLoad<Dim>::AppliedLoad(RunData<Dim>& run, std::size_t load)
    : Boundary<Dim>(run), table_(run.setup.loads[load].factor) {
  run.view.pushed = true;
  const std::vector<Vec<double, Dim>>& force = run.setup.loads[load].force;
  for (std::size_t id = 0; id < force.size(); ++id) {
    if (force[id].squaredNorm() > 0.0) forces_.push_back({run.slot_of[id], force[id]});
    sum_ += force[id];
  }
}

template <int Dim>
void AppliedLoad<Dim>::push() {
  RunData<Dim>& run = this->run_;
  const Particles<Dim>& p = run.particles;
  const double old_factor = factor_, old_path = path_;
  factor_ = table_.at(run.loading_time());
  path_ = 0.0;
  for (const Force& f : forces_) {
    for (std::size_t c = 0; c < run.dimensions; ++c) {
      const double force = f.force[static_cast<int>(c)];
      run.outer_force[c][f.slot] += factor_ * force;
      path_ += force * (p.position[c][f.slot] - p.start[c][f.slot]);
    }
  }
  // Trapezoidal in the force, as the leap-frog does its work.
  if (run.started) run.ledger.external += 0.5 * (old_factor + factor_) * (path_ - old_path);
}

template class AppliedLoad<2>;

}  // namespace fpz::sph::detail
