#include "bonded_platen.hpp"

namespace fpz::sph::detail {

template <int Dim>
BondedPlaten<Dim>::BondedPlaten(RunData<Dim>& run, std::size_t group)
    : Boundary<Dim>(run), motion_(run.setup.groups[group].motion) {
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    if (!motion_[c]) continue;
    const double velocity = motion_[c]->velocity(0.0);
    velocity_[static_cast<int>(c)] = velocity;
    for (std::size_t i = 0; i < run.particles.count; ++i) {
      if (run.setup.arrangement.group[run.particles.id[i]] != static_cast<int>(group)) continue;
      prescribed_.push_back({i, c});
      run.damping[c][i] = 0.0;
      run.particles.velocity[c][i] = velocity;
    }
  }
}

template <int Dim>
void BondedPlaten<Dim>::act(double step) {
  RunData<Dim>& run = this->run_;
  Particles<Dim>& p = run.particles;
  const Vec<double, Dim> old_reaction = reaction_;
  const Vec<double, Dim> old_velocity = velocity_;
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    if (motion_[c]) velocity_[static_cast<int>(c)] = prescribed_velocity(c);
  }
  reaction_.setZero();
  for (const Component& d : prescribed_) {
    const auto c = static_cast<int>(d.component);
    double& velocity = p.velocity[d.component][d.slot];
    double& acceleration = p.acceleration[d.component][d.slot];
    const double lacking = (velocity_[c] - velocity) / step;
    reaction_[c] += p.mass[d.slot] * lacking;
    acceleration += lacking;
    velocity = velocity_[c];
  }
  // Trapezoidal in the force: the work that makes the leap-frog's energy exact for an elastic body.
  if (run.started) run.ledger.external += 0.5 * run.dt * (old_reaction + reaction_).dot(old_velocity);
}

template <int Dim>
void BondedPlaten<Dim>::hold() {
  for (const Component& d : prescribed_) this->run_.particles.velocity[d.component][d.slot] = 0.0;
}

template class BondedPlaten<2>;

}  // namespace fpz::sph::detail
