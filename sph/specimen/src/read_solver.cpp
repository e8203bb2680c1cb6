// How a run gets through its loading (solver.hpp).
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

using Kind = Solver::Kind;

struct NumberKey {
  std::string_view key;
  double Solver::*member;
  double lowest, highest;  ///< both excluded
  std::vector<Kind> of;    ///< the kinds that have it
};

const std::vector<NumberKey>& number_keys() {
  static const std::vector<NumberKey> keys = {
      {"pace", &Solver::pace, 0.0, 1e6, {Kind::dynamic}},
      {"tolerance", &Solver::tolerance, 0.0, 1.0, {Kind::converged}},
      {"slowest", &Solver::slowest, 0.0, 1e6, {Kind::converged, Kind::adaptive}},
      {"kinetic_part", &Solver::kinetic_part, 0.0, 1.0, {Kind::adaptive, Kind::relaxation}},
      {"fastest", &Solver::fastest, 0.0, 1e6, {Kind::adaptive, Kind::relaxation}},
      {"increment", &Solver::increment, 0.0, 1e6, {Kind::relaxation}},
      {"rest_damping", &Solver::rest_damping, 0.0, 1.0, {Kind::relaxation}}};
  return keys;
}

void read_numbers(const InputReader& r, const Place& place, Solver& s) {
  std::vector<std::string_view> valid = {"type"};
  for (const NumberKey& k : number_keys()) {
    if (std::find(k.of.begin(), k.of.end(), s.kind) == k.of.end()) continue;
    valid.push_back(k.key);
    with(place, k.key, [&](const Place& p) { s.*k.member = r.number_between(p, k.lowest, k.highest).value_or(1.0); });
  }
  r.known_keys(place, valid);
  if (s.kind == Kind::adaptive && s.slowest > s.fastest) {
    r.problem(place, "\"slowest\" must not be above \"fastest\"");
  }
}

bool has_servo(const Scene& scene) {
  const auto steered = [](const Actuations& drive) {
    return std::any_of(drive.begin(), drive.end(), [](const auto& a) { return a && a->servo; });
  };
  return std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                     [&](const Boundary& b) { return steered(b.drive); });
}

}  // namespace

void read_solver(const InputReader& r, const Place& place, Scene& scene) {
  Solver& s = scene.solver;
  if (place.value().is(JsonValue::Kind::string)) {
    s.kind = choice<Kind>(r, place).value_or(s.kind);
  } else if (r.object(place, "a word, or an object with \"type\"")) {
    with_required(r, place, "type", [&](const Place& p) { s.kind = choice<Kind>(r, p).value_or(s.kind); });
    read_numbers(r, place, s);
  }
  if (s.kind == Kind::relaxation && (scene.stages.size() > 1 || has_servo(scene))) {
    r.problem(place, "\"relaxation\" knows neither stages nor servo control; use \"converged\"");
  }
}

}  // namespace fpz::specimen::detail
