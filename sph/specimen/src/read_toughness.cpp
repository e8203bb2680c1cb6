// How the toughness follows from the peak load.
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 3> toughness_keys = {"type", "notch", "factors"};
constexpr std::array<std::string_view, 1> types = {"semicircular_bending"};
constexpr std::array<std::string_view, 8> factor_keys = {"name",       "source",    "units", "notch_ratio",
                                                         "span_ratio", "angle_deg", "Y_I",   "Y_II"};
constexpr double same_geometry = 1e-3;  ///< relative difference up to which the factors of a geometry are taken

std::vector<double> numbers(const InputReader& r, const Place& p) {
  std::vector<double> list;
  if (!r.array(p, "numbers")) return list;
  for (const JsonValue& item : p.value().items) list.push_back(r.number(Place(p, item)).value_or(0.0));
  return list;
}

std::optional<IntensityFactors> read_factors(const InputReader& r, const Place& place) {
  const std::size_t before = r.problems().size();
  IntensityFactors f;
  if (!r.object(place, "the keys of stress intensity factors")) return std::nullopt;
  r.known_keys(place, factor_keys);
  with_required(r, place, "notch_ratio", [&](const Place& p) { f.notch_ratio = r.positive(p).value_or(1.0); });
  with_required(r, place, "span_ratio", [&](const Place& p) { f.span_ratio = r.positive(p).value_or(1.0); });
  with_required(r, place, "angle_deg", [&](const Place& p) {
    f.angle_deg = numbers(r, p);
    const bool ascending =
        std::adjacent_find(f.angle_deg.begin(), f.angle_deg.end(), std::greater_equal<>()) == f.angle_deg.end();
    if (f.angle_deg.size() < 2 || !ascending) r.problem(p, "needs at least two angles, ascending");
  });
  const auto factor = [&](std::string_view key, std::vector<double>& values) {
    with_required(r, place, key, [&](const Place& p) {
      values = numbers(r, p);
      if (values.size() != f.angle_deg.size()) {
        r.problem(p, "has " + std::to_string(values.size()) + " numbers, \"angle_deg\" has " +
                         std::to_string(f.angle_deg.size()));
      }
    });
  };
  factor("Y_I", f.Y_I);
  factor("Y_II", f.Y_II);
  if (r.problems().size() > before) return std::nullopt;
  return f;
}

/// Factors given inline, or in a file whose content then takes the place of its name.
std::optional<IntensityFactors> factors_of(const InputReader& r, const Place& place, JsonValue& tree) {
  if (!tree.is(JsonValue::Kind::string)) return read_factors(r, place);
  auto file = load_tree(r, place, "file of stress intensity factors");
  if (!file) return std::nullopt;
  auto factors = read_factors(InputReader(file->shown_as, r.limits(), r.problems()), Place(file->root));
  file->root.key = tree.key;
  tree = std::move(file->root);
  return factors;
}

/// Half the distance of the two rollers below the specimen, m.
std::optional<double> half_span(const Scene& scene) {
  std::vector<double> x;
  for (const Boundary& b : scene.boundaries) {
    if (b.platen && b.platen->direction.normalized()[1] < -0.99) x.push_back(b.platen->at[0]);
  }
  if (x.size() != 2) return std::nullopt;
  return 0.5 * std::abs(x[0] - x[1]);
}

void require_same(const InputReader& r, const Place& p, const char* what, double scene, double table) {
  if (std::abs(scene - table) <= same_geometry * table) return;
  r.problem(p,
            std::string(what) + " of the scene is " + io::exact(scene) + ", the factors hold for " + io::exact(table));
}

std::optional<SemicircularBending> semicircular_bending(const InputReader& r, const Place& place, const Scene& scene,
                                                        const Notch& notch, const IntensityFactors& f) {
  const std::size_t before = r.problems().size();
  const auto* half = std::get_if<HalfDisc>(&scene.body.shape);
  if (half == nullptr) {
    r.problem(place, "the shape must be a half_disc");
    return std::nullopt;
  }
  SemicircularBending s;
  s.radius = half->radius;
  s.notch_length = (notch.tip - notch.mouth).norm();
  if ((notch.mouth - half->centre).norm() > same_geometry * s.radius) {
    r.problem(place, "the notch must begin at the centre of the half disc");
  }
  require_same(r, place, "notch length over radius", s.notch_length / s.radius, f.notch_ratio);
  if (const auto span = half_span(scene)) {
    require_same(r, place, "half span over radius", *span / s.radius, f.span_ratio);
  } else {
    r.problem(place, "needs two boundaries below the specimen (\"direction\": [0, -1])");
  }
  const Point d = along(notch);
  const double angle = std::abs(std::atan2(d[0], d[1])) * 180.0 / std::numbers::pi;
  if (angle < f.angle_deg.front() - 1e-9 || angle > f.angle_deg.back() + 1e-9) {
    r.problem(place, "the notch is at " + io::exact(angle) + " degrees, the factors are for " +
                         io::exact(f.angle_deg.front()) + " to " + io::exact(f.angle_deg.back()));
  }
  if (r.problems().size() > before) return std::nullopt;
  std::tie(s.Y_I, s.Y_II) = f.at(angle);
  return s;
}

}  // namespace

void read_toughness(const InputReader& r, JsonValue& root, Scene& scene) {
  const Place top(root);
  JsonValue* given = member(root, "toughness");
  if (given == nullptr) return;
  const Place place(top, *given);
  if (!r.object(place, "\"type\", \"notch\" and \"factors\"")) return;
  r.known_keys(place, toughness_keys);
  with_required(r, place, "type", [&](const Place& p) { (void)word(r, p, types); });
  const Notch* notch = nullptr;
  with_required(r, place, "notch", [&](const Place& p) { notch = notch_at(r, p, scene); });
  std::optional<IntensityFactors> factors;
  with_required(r, place, "factors", [&](const Place& p) { factors = factors_of(r, p, *member(*given, "factors")); });
  // A geometry that could not be read has default values, about which nothing should be said.
  if (notch == nullptr || !factors || !r.problems().empty()) return;
  scene.toughness = semicircular_bending(r, place, scene, *notch, *factors);
}

}  // namespace fpz::specimen::detail
