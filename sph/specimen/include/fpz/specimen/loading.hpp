// How a scene drives its boundaries and loads its surface over time.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fpz/specimen/geometry.hpp"
#include "fpz/sph/group.hpp"

namespace fpz::specimen {

/// A quantity over time as a scene states it; the clock is that of the stage. Forces are for the whole thickness.
struct TimeCourse {
  enum class Form : std::uint8_t {
    rise,   ///< smoothly from what it is when the stage begins to `value`, within `ramp`, and stays
    table,  ///< as in `table`
    hold    ///< stays what it is when the stage begins
  };
  Form form = Form::rise;
  double value = 0.0;
  double ramp = 0.0;  ///< s
  sph::TimeTable table;

  /// As a table that begins at `time` (s), where the quantity is `present`.
  [[nodiscard]] sph::TimeTable starting(double time, double present) const;
  /// s after the begin: nothing changes from there on.
  [[nodiscard]] double duration() const;
  /// Of the values that it states.
  [[nodiscard]] double largest() const;
};

/// A velocity that follows so that a gauge grows at a rate (src/servo.hpp).
struct Servo {
  std::string gauge;
  double rate = 0.0;           ///< of the gauge, its unit per second, > 0
  double ramp = 0.0;           ///< s, within which the rate is reached
  double speed = 0.0;          ///< m/s: its sign is the direction in which the gauge grows
  double fastest = 0.0;        ///< m/s, > 0: largest speed in either direction
  double time_constant = 0.0;  ///< s; 0: from the scene
};

/// How one component of a boundary is driven.
struct Actuation {
  sph::Drive::Kind kind = sph::Drive::Kind::velocity;
  TimeCourse course;
  double machine_stiffness = 0.0;             ///< N/m, for the whole thickness; 0: rigid
  std::optional<Servo> servo = std::nullopt;  ///< of a steered component

  /// For the engine, from `time` on (s), where velocity (m/s) and force (N, for the whole thickness) are the present
  /// ones.
  [[nodiscard]] sph::Drive starting(double time, double velocity, double force, double thickness) const;
};

/// Of the components x and y; none: free.
using Actuations = std::array<std::optional<Actuation>, 2>;

/// A part of the surface: where all that is given holds.
struct SurfacePart {
  bool outside = false;              ///< the outline of the shape, without holes and slots
  std::optional<std::size_t> hole;   ///< the outline of this hole
  std::optional<std::size_t> notch;  ///< the faces and the end of this slot
  std::optional<Shape> within;       ///< rectangle or polygon, its rim included
  struct Sector {
    Point centre = Point::Zero();
    double from = 0.0, to = 0.0;  ///< radian, counter-clockwise from the direction +x; from < to
  };
  std::optional<Sector> sector;  ///< seen from its centre
};

/// A pressure or a traction on parts of the surface.
struct SurfaceLoad {
  std::string name;
  std::vector<SurfacePart> on;
  std::optional<Point> direction;  ///< of a traction, unit length; none: a pressure, which pushes inward
  TimeCourse course;               ///< Pa
};

}  // namespace fpz::specimen
