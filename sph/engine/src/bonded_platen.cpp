#include "bonded_platen.hpp"

#include <cmath>
#include <stdexcept>

namespace fpz::sph::detail {

template <int Dim>
BondedPlaten<Dim>::BondedPlaten(RunData<Dim>& run, std::size_t group)
    : Boundary<Dim>(run), drive_(run.setup.groups[group].drive) {
  Particles<Dim>& p = run.particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (run.setup.arrangement.group[p.id[i]] != static_cast<int>(group)) continue;
    slots_.push_back(i);
    mass_ += p.mass[i];
  }
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    if (!drive_[c]) continue;
    const bool moves = drive_[c]->kind == Drive::Kind::velocity && !drive_[c]->yields();
    const double velocity = moves ? drive_[c]->table.at(0.0) : 0.0;
    velocity_[static_cast<int>(c)] = velocity;
    for (const std::size_t i : slots_) {
      run.damping[c][i] = 0.0;
      if (moves) p.velocity[c][i] = velocity;
    }
  }
}

template <int Dim>
double BondedPlaten<Dim>::drive_velocity(std::size_t c) const {
  const Drive& d = *drive_[c];
  const double now = this->run_.now(), dt = this->run_.dt;
  switch (d.kind) {
    case Drive::Kind::velocity:
      return d.table.at(now + 0.5 * dt);
    case Drive::Kind::displacement:
      return (d.table.at(now + dt) - d.table.at(now)) / dt;
    case Drive::Kind::steered:
      return steered_[static_cast<int>(c)];
    case Drive::Kind::force:
      break;
  }
  return 0.0;
}

template <int Dim>
double BondedPlaten<Dim>::outer_force(std::size_t c) const {
  const Drive& d = *drive_[c];
  if (d.kind == Drive::Kind::force) return d.table.at(this->run_.now());
  return d.machine_stiffness * stretch_[static_cast<int>(c)];
}

template <int Dim>
double BondedPlaten<Dim>::next_velocity(std::size_t c, double step) const {
  if (!drive_[c]->yields()) return drive_velocity_[static_cast<int>(c)];
  const Particles<Dim>& p = this->run_.particles;
  double momentum = step * outer_force(c);
  for (const std::size_t i : slots_) momentum += p.mass[i] * p.velocity[c][i];
  return momentum / mass_;
}

template <int Dim>
void BondedPlaten<Dim>::act(double step) {
  RunData<Dim>& run = this->run_;
  Particles<Dim>& p = run.particles;
  const Vector old_reaction = reaction_;
  const Vector old_velocity = velocity_;
  if (run.started) stretch_ += run.dt * (drive_velocity_ - velocity_);
  reaction_.setZero();
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    if (!drive_[c]) continue;
    const auto k = static_cast<int>(c);
    drive_velocity_[k] = drive_velocity(c);
    velocity_[k] = next_velocity(c, step);
    for (const std::size_t i : slots_) {
      const double lacking = (velocity_[k] - p.velocity[c][i]) / step;
      reaction_[k] += p.mass[i] * lacking;
      p.acceleration[c][i] += lacking;
      p.velocity[c][i] = velocity_[k];
    }
  }
  // Trapezoidal in the force: the work that makes the leap-frog's energy exact for an elastic body.
  if (run.started) run.ledger.external += 0.5 * run.dt * (old_reaction + reaction_).dot(old_velocity);
}

template <int Dim>
void BondedPlaten<Dim>::hold() {
  Particles<Dim>& p = this->run_.particles;
  for (std::size_t c = 0; c < this->run_.dimensions; ++c) {
    if (!drive_[c]) continue;
    double mean = 0.0;
    if (drive_[c]->yields()) {
      for (const std::size_t i : slots_) mean += p.mass[i] / mass_ * p.velocity[c][i];
    }
    for (const std::size_t i : slots_) p.velocity[c][i] = mean;
  }
}

template <int Dim>
double BondedPlaten<Dim>::stable_step() const {
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& d : drive_) {
    if (d && d->machine_stiffness > 0.0) limit = std::min(limit, 2.0 * std::sqrt(mass_ / d->machine_stiffness));
  }
  return limit;
}

template <int Dim>
void BondedPlaten<Dim>::set_drive(std::size_t c, const Drive& drive) {
  if (!drive_[c]) {
    throw std::invalid_argument("a component that was free stays free: drive it from the start, with a force of 0");
  }
  const auto k = static_cast<int>(c);
  drive_[c] = drive;
  stretch_[k] = drive.machine_stiffness > 0.0 ? reaction_[k] / drive.machine_stiffness : 0.0;
}

template class BondedPlaten<2>;

}  // namespace fpz::sph::detail
