// What drives one component of a group, and the machine between the drive and the group (group.hpp, Drive).
#pragma once

#include "fpz/sph/group.hpp"

namespace fpz::sph::detail {

struct Actuator {
  Drive drive;
  double steered = 0.0;         ///< m/s
  double stretch = 0.0;         ///< of the machine at n: way of the drive less that of the group, m
  double drive_velocity = 0.0;  ///< from n to n + 1, m/s

  [[nodiscard]] bool yields() const { return drive.yields(); }
  /// Velocity that a group has from the start on, m/s; nothing when it sets out from rest.
  [[nodiscard]] std::optional<double> start_velocity() const;
  /// Longest time step of the machine with a mass (kg) behind it, s.
  [[nodiscard]] double stable_step(double mass) const;
  /// To n, where the clock shows `now` (s) and the drive sets out for n + 1, `step` (s) later, at that pace of the
  /// clock; the group has moved at `group_velocity` (m/s) for `past` (s).
  void advance(double now, double pace, double step, double past, double group_velocity);
  /// On a group that yields, at n, where the clock shows `now` (s), N.
  [[nodiscard]] double force(double now) const;
  /// Another drive from n on. The force goes on from what it is: a machine begins as strained as that takes.
  void change(const Drive& other, double force);
};

template <class Archive, class A>
void transfer(Archive& archive, A& actuator) requires std::same_as<std::remove_const_t<A>, Actuator> {
  auto& [drive, steered, stretch, drive_velocity] = actuator;  // a member that is not handed on does not compile
  archive(drive), archive(steered), archive(stretch), archive(drive_velocity);
}

}  // namespace fpz::sph::detail
