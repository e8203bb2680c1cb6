#include "fpz/specimen/loading.hpp"

#include <algorithm>
#include <cmath>

namespace fpz::specimen {

using Kind = sph::Drive::Kind;

sph::TimeTable TimeCourse::starting(double time, double present) const {
  sph::TimeTable all = table;
  if (form == Form::rise) all = sph::TimeTable::rise(present, value, ramp);
  if (form == Form::hold) all = sph::TimeTable::constant(present);
  all.start = time;
  return all;
}

double TimeCourse::duration() const {
  if (form == Form::table) return table.time.back();
  return form == Form::rise ? ramp : 0.0;
}

double TimeCourse::largest() const {
  double most = form == Form::rise ? std::abs(value) : 0.0;
  for (const double x : table.value) most = std::max(most, std::abs(x));
  return most;
}

sph::Drive Actuation::starting(double time, double velocity, double force, double thickness) const {
  const double present = kind == Kind::velocity ? velocity : kind == Kind::force ? force : 0.0;
  sph::Drive drive(kind, course.starting(time, present), machine_stiffness / thickness);
  if (kind == Kind::force) {
    drive.machine_stiffness = 0.0;
    for (double& f : drive.table.value) f /= thickness;
  }
  return drive;
}

}  // namespace fpz::specimen
