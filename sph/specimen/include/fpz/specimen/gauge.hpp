// Gauges: what a scene wants measured, and the same bound to particles. One file per kind (src/gauge_*.cpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fpz/specimen/geometry.hpp"
#include "fpz/sph/simulation.hpp"

namespace fpz::specimen {

/// Some particles of the undeformed body: a boundary group, those around a point (the nearest one when none is within
/// the radius), or those in a box.
struct Site {
  std::string group;
  Point centre = Point::Zero();
  double radius = 0.0;
  std::optional<Rectangle> box;
};

/// Force by which boundary groups are held, in a direction. N.
struct ForceGauge {
  std::vector<std::string> groups;
  Point direction = Point::Zero();
};
/// Mean displacement of a site, less that of another one, in a direction. m.
struct DisplacementGauge {
  Site of;
  std::vector<Site> relative_to;  ///< the mean of these; none: space
  Point direction = Point::Zero();
};
/// Displacement of one face of a notch against the other at its mouth, positive when it opens. m.
struct OpeningGauge {
  Point mouth = Point::Zero();
  Point direction = Point::Zero();  ///< across the notch, unit length
  double half_width = 0.0;          ///< m
};
/// A component of a symmetric tensor in the plane; its value is the index in the engine's fields.
enum class PlaneComponent : std::uint8_t { xx, yy, xy };
/// Mean stress of a site. Pa.
struct StressGauge {
  Site of;
  PlaneComponent component = PlaneComponent::xx;
};
/// Mean strain of a site, extension positive; xy is half of the change of the right angle.
struct StrainGauge {
  Site of;
  PlaneComponent component = PlaneComponent::xx;
};
/// Mean rotation of a site, rad, counter-clockwise.
struct RotationGauge {
  Site of;
};
/// Other gauges times factors; over another such sum, where there is one.
struct SumGauge {
  struct Term {
    std::string gauge;
    double factor = 1.0;
  };
  std::vector<Term> terms, over;
};
using Gauge =
    std::variant<ForceGauge, DisplacementGauge, OpeningGauge, StressGauge, StrainGauge, RotationGauge, SumGauge>;
/// The only site of a gauge of stress, strain or rotation; null for others.
[[nodiscard]] const Site* site_of(const Gauge& gauge);

/// A gauge that knows its particles.
struct BoundGauge {
  /// Its value at the present step, in SI units. Forces are for the whole thickness (m).
  std::function<double(const sph::Simulation<2>& run, double thickness)> value;
  std::vector<std::vector<std::size_t>> sites;  ///< particles that it looks at, indices in the arrangement
};

}  // namespace fpz::specimen

namespace fpz {

template <>
struct Words<specimen::PlaneComponent> {
  static constexpr Word<specimen::PlaneComponent> list[] = {
      {specimen::PlaneComponent::xx, "xx"}, {specimen::PlaneComponent::yy, "yy"}, {specimen::PlaneComponent::xy, "xy"}};
};

}  // namespace fpz
