#include "actuator.hpp"

#include <cmath>
#include <limits>

namespace fpz::sph::detail {

std::optional<double> Actuator::start_velocity() const {
  if (drive.kind != Drive::Kind::velocity || yields()) return std::nullopt;
  return drive.table.at(0.0);
}

double Actuator::stable_step(double mass) const {
  if (!(drive.machine_stiffness > 0.0)) return std::numeric_limits<double>::infinity();
  return 2.0 * std::sqrt(mass / drive.machine_stiffness);
}

void Actuator::advance(double now, double pace, double step, double past, double group_velocity) {
  stretch += past * (drive_velocity - group_velocity);
  switch (drive.kind) {
    case Drive::Kind::velocity:
      drive_velocity = pace * drive.table.at(now + 0.5 * pace * step);
      break;
    case Drive::Kind::displacement:
      drive_velocity = (drive.table.at(now + pace * step) - drive.table.at(now)) / step;
      break;
    case Drive::Kind::steered:
      drive_velocity = steered;
      break;
    case Drive::Kind::force:
      drive_velocity = 0.0;
      break;
  }
}

double Actuator::force(double now) const {
  return drive.kind == Drive::Kind::force ? drive.table.at(now) : drive.machine_stiffness * stretch;
}

void Actuator::change(const Drive& other, double force) {
  drive = other;
  stretch = drive.machine_stiffness > 0.0 ? force / drive.machine_stiffness : 0.0;
}

}  // namespace fpz::sph::detail
