#include "hinged_platen.hpp"

#include <Eigen/LU>

namespace fpz::sph::detail {

template <int Dim>
HingedPlaten<Dim>::HingedPlaten(RunData<Dim>& run, std::size_t group)
    : Boundary<Dim>(run), slots_(slots_of_group(run, group)), hinge_(*run.setup.groups[group].hinge) {
  const Group<Dim>& g = run.setup.groups[group];
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    actuator_[c].drive = g.drive[c] ? *g.drive[c] : Drive{Drive::Kind::force, TimeTable::constant(0.0)};
    motion_[static_cast<int>(c)] = actuator_[c].start_velocity().value_or(0.0);
  }
  for (const std::size_t i : slots_) {
    mass_ += run.particles.mass[i];
    for (std::size_t c = 0; c < run.dimensions; ++c) {
      run.damping[c][i] = 0.0;
      run.particles.velocity[c][i] = motion_[static_cast<int>(c)];
    }
  }
}

template <int Dim>
Vec<double, Dim> HingedPlaten<Dim>::velocity_at(std::size_t i, const Rigid& motion) const {
  const Fields<Dim>& x = this->run_.particles.position;
  return {motion[0] - motion[2] * (x[1][i] - hinge_[1]), motion[1] + motion[2] * (x[0][i] - hinge_[0])};
}

template <int Dim>
auto HingedPlaten<Dim>::rigid_motion(const Vec<double, Dim>& impulse,
                                     const std::array<std::optional<double>, 2>& prescribed) const -> Rigid {
  const Particles<Dim>& p = this->run_.particles;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d momentum(impulse[0], impulse[1], 0.0);
  for (const std::size_t i : slots_) {
    const double x = p.position[0][i] - hinge_[0], y = p.position[1][i] - hinge_[1], m = p.mass[i];
    Eigen::Matrix3d own;
    own << 1.0, 0.0, -y, 0.0, 1.0, x, -y, x, x * x + y * y;
    inertia += m * own;
    momentum += m * Eigen::Vector3d(p.velocity[0][i], p.velocity[1][i], x * p.velocity[1][i] - y * p.velocity[0][i]);
  }
  for (int c = 0; c < Dim; ++c) {
    const std::optional<double>& velocity = prescribed[static_cast<std::size_t>(c)];
    if (!velocity) continue;
    inertia.row(c) = inertia(c, c) * Eigen::RowVector3d::Unit(c);
    momentum[c] = inertia(c, c) * *velocity;
  }
  return Eigen::Vector3d(inertia.fullPivLu().solve(momentum));
}

template <int Dim>
void HingedPlaten<Dim>::act(double step) {
  RunData<Dim>& run = this->run_;
  const Vec<double, Dim> old_reaction = reaction_, old_velocity = velocity();
  const double past = run.started ? run.dt : 0.0;
  hinge_ += past * old_velocity;
  Vec<double, Dim> impulse = Vec<double, Dim>::Zero();
  std::array<std::optional<double>, 2> prescribed;
  for (std::size_t c = 0; c < run.dimensions; ++c) {
    Actuator& actuator = actuator_[c];
    actuator.advance(run.loading_time(), run.clock.pace, run.dt, past, old_velocity[static_cast<int>(c)]);
    if (actuator.yields()) {
      impulse[static_cast<int>(c)] = step * actuator.force(run.loading_time());
    } else {
      prescribed[c] = actuator.drive_velocity;
    }
  }
  motion_ = rigid_motion(impulse, prescribed);
  reaction_.setZero();
  for (const std::size_t i : slots_) {
    const Vec<double, Dim> own = velocity_at(i, motion_);
    for (std::size_t c = 0; c < run.dimensions; ++c) {
      const auto k = static_cast<int>(c);
      reaction_[k] += this->impose(i, c, own[k], step);
    }
  }
  // As for bonded platens; without a moment the rotation takes no work.
  if (run.started) run.ledger.external += 0.5 * run.dt * (old_reaction + reaction_).dot(old_velocity);
}

template <int Dim>
void HingedPlaten<Dim>::hold() {
  std::array<std::optional<double>, 2> prescribed;
  for (std::size_t c = 0; c < this->run_.dimensions; ++c) {
    if (!actuator_[c].yields()) prescribed[c] = 0.0;
  }
  const Rigid motion = rigid_motion(Vec<double, Dim>::Zero(), prescribed);
  for (const std::size_t i : slots_) {
    const Vec<double, Dim> own = velocity_at(i, motion);
    for (std::size_t c = 0; c < this->run_.dimensions; ++c) {
      this->run_.particles.velocity[c][i] = own[static_cast<int>(c)];
    }
  }
}

/// Half of the mass moves with the hinge at least, when its motion turns the platen about the far end.
template <int Dim>
double HingedPlaten<Dim>::stable_step() const {
  double limit = std::numeric_limits<double>::infinity();
  for (const Actuator& a : actuator_) limit = std::min(limit, a.stable_step(0.25 * mass_));
  return limit;
}

template <int Dim>
void HingedPlaten<Dim>::set_drive(std::size_t c, const Drive& drive) {
  actuator_[c].change(drive, reaction_[static_cast<int>(c)]);
}

template class HingedPlaten<2>;

}  // namespace fpz::sph::detail
