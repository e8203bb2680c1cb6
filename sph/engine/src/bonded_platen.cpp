#include "bonded_platen.hpp"

#include <stdexcept>

namespace fpz::sph::detail {

template <int Dim>
BondedPlaten<Dim>::BondedPlaten(RunData<Dim>& run, std::size_t group)
    : Boundary<Dim>(run), slots_(slots_of_group(run, group)) {
  Particles<Dim>& p = run.particles;
  for (const std::size_t i : slots_) mass_ += p.mass[i];
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    const std::optional<Drive>& drive = run.setup.groups[group].drive[c];
    if (!drive) continue;
    actuator_[c] = Actuator{*drive};
    const std::optional<double> velocity = actuator_[c]->start_velocity();
    velocity_[static_cast<int>(c)] = velocity.value_or(0.0);
    for (const std::size_t i : slots_) {
      run.damping[c][i] = 0.0;
      if (velocity) p.velocity[c][i] = *velocity;
    }
  }
}

template <int Dim>
double BondedPlaten<Dim>::next_velocity(std::size_t c, double step) const {
  const Actuator& actuator = *actuator_[c];
  if (!actuator.yields()) return actuator.drive_velocity;
  const Particles<Dim>& p = this->run_.particles;
  double momentum = step * actuator.force(this->run_.loading_time());
  for (const std::size_t i : slots_) momentum += p.mass[i] * p.velocity[c][i];
  return momentum / mass_;
}

template <int Dim>
void BondedPlaten<Dim>::act(double step) {
  RunData<Dim>& run = this->run_;
  const Vec<double, Dim> old_reaction = reaction_;
  const Vec<double, Dim> old_velocity = velocity_;
  reaction_.setZero();
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    if (!actuator_[c]) continue;
    const auto k = static_cast<int>(c);
    actuator_[c]->advance(run.loading_time(), run.clock.pace, run.dt, run.started ? run.dt : 0.0, velocity_[k]);
    velocity_[k] = next_velocity(c, step);
    for (const std::size_t i : slots_) reaction_[k] += this->impose(i, c, velocity_[k], step);
  }
  // Trapezoidal in the force: the work that makes the leap-frog's energy exact for an elastic body.
  if (run.started) run.ledger.external += 0.5 * run.dt * (old_reaction + reaction_).dot(old_velocity);
}

template <int Dim>
void BondedPlaten<Dim>::hold() {
  Particles<Dim>& p = this->run_.particles;
  for (std::size_t c = 0; c < this->run_.dimensions; ++c) {
    if (!actuator_[c]) continue;
    double mean = 0.0;
    if (actuator_[c]->yields()) {
      for (const std::size_t i : slots_) mean += p.mass[i] / mass_ * p.velocity[c][i];
    }
    for (const std::size_t i : slots_) p.velocity[c][i] = mean;
  }
}

template <int Dim>
void BondedPlaten<Dim>::mark_driven(Mask& components) const {
  for (std::size_t c = 0; c < this->run_.dimensions; ++c) {
    if (!actuator_[c]) continue;
    for (const std::size_t i : slots_) components[i] = static_cast<unsigned char>(components[i] | (1U << c));
  }
}

template <int Dim>
double BondedPlaten<Dim>::stable_step() const {
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& a : actuator_) {
    if (a) limit = std::min(limit, a->stable_step(mass_));
  }
  return limit;
}

template <int Dim>
void BondedPlaten<Dim>::set_drive(std::size_t c, const Drive& drive) {
  if (!actuator_[c]) {
    throw std::invalid_argument("a component that was free stays free: drive it from the start, with a force of 0");
  }
  actuator_[c]->change(drive, reaction_[static_cast<int>(c)]);
}

template <int Dim>
void BondedPlaten<Dim>::steer(std::size_t c, double velocity) {
  if (actuator_[c]) actuator_[c]->steered = velocity;
}

template class BondedPlaten<2>;

}  // namespace fpz::sph::detail
