// Sites: which particles a gauge looks at.
#include "fpz/io/input_error.hpp"
#include "gauge_kinds.hpp"

namespace fpz::specimen {
namespace detail {
namespace {

constexpr std::array<std::string_view, 5> site_keys = {"group", "point", "radius", "low", "high"};

}  // namespace
}  // namespace detail

const Site* site_of(const Gauge& gauge) {
  if (const auto* stress = std::get_if<StressGauge>(&gauge)) return &stress->of;
  if (const auto* strain = std::get_if<StrainGauge>(&gauge)) return &strain->of;
  if (const auto* rotation = std::get_if<RotationGauge>(&gauge)) return &rotation->of;
  return nullptr;
}

namespace detail {

std::string read_group_name(const InputReader& r, const Place& place, const Scene& scene) {
  const auto name = r.text(place, longest_name);
  if (!name) return {};
  std::vector<std::string_view> valid;
  for (const Boundary& b : scene.boundaries) valid.push_back(b.name);
  if (std::find(valid.begin(), valid.end(), *name) == valid.end()) {
    r.problem(place, "there is no boundary " + io::in_quotes(*name) + io::suggestion(*name, valid));
  }
  return *name;
}

Site read_site(const InputReader& r, const Place& place, const Scene& scene) {
  Site s;
  if (place.value().is(JsonValue::Kind::string)) {
    s.group = read_group_name(r, place, scene);
    return s;
  }
  if (!r.object(place, "\"group\", or \"point\" (and \"radius\"), or \"low\" and \"high\"")) return s;
  r.known_keys(place, site_keys);
  const bool group = place.value().find("group") != nullptr;
  const bool point_given = place.value().find("point") != nullptr;
  const bool box = place.value().find("low") != nullptr || place.value().find("high") != nullptr;
  if (group + point_given + box != 1) {
    r.problem(place, "needs one of \"group\", \"point\" (and \"radius\"), or \"low\" and \"high\"");
    return s;
  }
  if (group) with(place, "group", [&](const Place& p) { s.group = read_group_name(r, p, scene); });
  if (point_given) {
    with(place, "point", [&](const Place& p) { s.centre = point(r, p).value_or(s.centre); });
    with(place, "radius", [&](const Place& p) { s.radius = not_negative(r, p).value_or(0.0); });
  }
  if (box) {
    s.box.emplace();
    with_required(r, place, "low", [&](const Place& p) { s.box->low = point(r, p).value_or(s.box->low); });
    with_required(r, place, "high", [&](const Place& p) { s.box->high = point(r, p).value_or(s.box->high); });
  }
  return s;
}

std::vector<std::size_t> particles_of(const Site& site, const GaugeBinding& to) {
  const Scene& scene = to.scene;
  const sph::Arrangement<2>& a = to.arrangement;
  std::vector<std::size_t> found;
  if (!site.group.empty()) {
    for (std::size_t b = 0; b < scene.boundaries.size(); ++b) {
      if (scene.boundaries[b].name != site.group) continue;
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (a.group[i] == static_cast<int>(b)) found.push_back(i);
      }
    }
    return found;
  }
  double nearest = 1e300;
  std::size_t closest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.group[i] != sph::Arrangement<2>::specimen) continue;
    const Point& x = a.position[i];
    if (site.box) {
      if (((x - site.box->low).array() >= 0.0).all() && ((site.box->high - x).array() >= 0.0).all()) found.push_back(i);
      continue;
    }
    const double d = (x - site.centre).norm();
    if (d <= site.radius) found.push_back(i);
    if (d < nearest) nearest = d, closest = i;
  }
  if (found.empty() && site.box) {
    throw io::InputError(scene.name + ": gauge \"" + to.name + "\": no particle in its box");
  }
  // Particles equally near all count: which one is first would be an accident.
  if (found.empty()) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a.group[i] == sph::Arrangement<2>::specimen &&
          (a.position[i] - site.centre).norm() <= nearest + 1e-6 * a.spacing) {
        found.push_back(i);
      }
    }
    if (found.empty()) found.push_back(closest);
  }
  return found;
}

}  // namespace detail
}  // namespace fpz::specimen
