// Boundary groups: particles that move together, with some components driven and the others free; and forces on the
// particles of the body.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fpz/sph/time_table.hpp"
#include "fpz/types.hpp"

namespace fpz::sph {

/// A velocity that rises smoothly (a cubic, no jump of acceleration at its ends beyond a finite one) from zero to
/// `speed` (m/s) within `ramp` (s) and stays.
struct Motion {
  double speed = 0.0;
  double ramp = 0.0;
};

/// What moves one component of a group: all its particles have one velocity there.
struct Drive {
  enum class Kind : std::uint8_t {
    velocity,      ///< the table is a velocity, m/s
    displacement,  ///< the table is a displacement, m; only its changes count
    force,         ///< the table is the force on the group, N (per metre of thickness in 2-D)
    steered        ///< the velocity is what Simulation::steer() says
  };
  Kind kind = Kind::velocity;
  TimeTable table = TimeTable::constant(0.0);
  /// N/m (per metre of thickness): of a machine between the drive (velocity, displacement, steered) and the group. 0:
  /// rigid.
  double machine_stiffness = 0.0;

  Drive() = default;
  Drive(Kind k, TimeTable t, double stiffness = 0.0) : kind(k), table(std::move(t)), machine_stiffness(stiffness) {}
  Drive(const Motion& m) : table(TimeTable::rise(0.0, m.speed, m.ramp)) {}  // NOLINT: a motion is a drive

  /// Whether the velocity of the group follows from the forces on it.
  [[nodiscard]] bool yields() const { return kind == Kind::force || machine_stiffness > 0.0; }
};

template <class Archive, class D>
void transfer(Archive& archive, D& drive) requires std::same_as<std::remove_const_t<D>, Drive> {
  archive(drive.kind), archive(drive.table), archive(drive.machine_stiffness);
}

template <int Dim>
struct Group {
  std::string name;
  std::array<std::optional<Drive>, static_cast<std::size_t>(Dim)> drive;  ///< per component; empty: free
  bool elastic = true;                                                    ///< its particles never crack
  /// A point about which the group turns freely as a rigid body, m; the drives are those of this point.
  std::optional<Vec<double, Dim>> hinge = std::nullopt;
  /// Its particles have bonds with the body. Else it touches the body where a cut lies between them
  /// (Arrangement::cuts), by contact, in `reference`.
  bool bonded = true;
  /// Its particles have no bonds with those of other groups: platens that meet at a corner of the body.
  bool keeps_to_itself = false;
};

/// Forces that particles of the body feel, in a fixed pattern times a number that changes.
template <int Dim>
struct Load {
  std::string name;
  std::vector<Vec<double, Dim>> force;  ///< of each particle of the arrangement, N (per metre of thickness in 2-D)
  TimeTable factor = TimeTable::constant(1.0);
};

}  // namespace fpz::sph
