#include "out_of_plane.hpp"

#include <cmath>
#include <optional>
#include <sstream>

#include "fpz/out_of_plane.hpp"

namespace fpz::driver {
namespace {

struct Moment {
  double time = 0.0;
  Tensor<double, 2> stress;  ///< xx, yy, xy, Pa
};

Moment moment_of(double time, const std::array<double, 6>& stress) { return {time, {stress[0], stress[1], stress[3]}}; }

/// The uncracked states of a path, the onset as the last one.
std::vector<Moment> uncracked(const Result& result) {
  std::vector<Moment> all;
  for (const Row& r : result.history) {
    if (r.cracked) break;
    all.push_back(moment_of(r.time, r.stress));
  }
  const auto& onset = result.summary.onset;
  if (onset) all.push_back(moment_of(onset->time, onset->stress));
  return all;
}

/// Between two states, where the failure value in space reaches zero: it is convex along the straight way.
Moment crossing(const Material<double>& m, const Moment& before, const Moment& after) {
  const auto at = [&](double x) {
    return Moment{before.time + x * (after.time - before.time), before.stress + x * (after.stress - before.stress)};
  };
  double inside = 0.0, beyond = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (inside + beyond);
    (failure_value_in_space(m, at(middle).stress) < 0.0 ? inside : beyond) = middle;
  }
  return at(beyond);
}

std::optional<Moment> first_failure(const Material<double>& m, const std::vector<Moment>& path) {
  const double nothing = 1e-6 * m.law.surface.cohesion;  // the onset itself is on the surface
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (failure_value_in_space(m, path[k].stress) <= nothing) continue;
    return k == 0 ? path[k] : crossing(m, path[k - 1], path[k]);
  }
  return std::nullopt;
}

}  // namespace

std::string warning_out_of_plane(const Test& test, const Result& result) {
  if (test.setting == Setting::three_d) return "";
  const Material<double> m = make_material(test.parameters, test.setting);
  const std::optional<Moment> found = first_failure(m, uncracked(result));
  if (!found) return "";
  std::ostringstream text;
  text.precision(4);
  text << "test \"" << test.name << "\": setting = \"" << to_string(test.setting)
       << "\" looks at planes that contain the out-of-plane axis only, but one that is inclined to it fails first, at "
          "time "
       << found->time << ": sig_xx = " << 1e-6 * found->stress[0] << ", sig_yy = " << 1e-6 * found->stress[1]
       << ", sig_zz = " << 1e-6 * elastic_stress_zz(m, found->stress) << ", sig_xy = " << 1e-6 * found->stress[2]
       << " MPa. Strengths beyond that are too high; use \"setting\": \"" << to_string(Setting::three_d)
       << "\" with the same stresses.";
  return text.str();
}

}  // namespace fpz::driver
