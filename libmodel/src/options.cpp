#include "fpz/options.hpp"

#include <cmath>

namespace fpz {

Validation validate(const Options& o) {
  Validation result;
  const auto require = [&result](bool holds, const char* field, double v, const char* constraint) {
    if (!holds) result.errors.push_back({field, v, constraint});  // NaN does not hold
  };
  require(o.tolerance > 0.0 && o.tolerance < 1.0, "tolerance", o.tolerance, "must be > 0 and < 1");
  require(o.max_iterations >= 1, "max_iterations", o.max_iterations, "must be >= 1");
  require(o.max_substeps >= 1, "max_substeps", o.max_substeps, "must be >= 1");
  require(o.scan_resolution_deg == 0.0 || (o.scan_resolution_deg >= 0.01 && o.scan_resolution_deg <= 10.0),
          "scan_degrees", o.scan_resolution_deg, "must be 0 (closed form) or between 0.01 and 10");
  for (const double x : o.preferred_normal) require(std::isfinite(x), "preferred_normal", x, "must be finite");
  return result;
}

std::string why_unfit(Method method, const MaterialChoices& choices) {
  if (method != Method::paper || choices.cohesive_zone == CohesiveZone::published) return {};
  return "paper integrates the published zone only: add \"cohesive_zone\": \"published\" to the material, or use "
         "accurate or implicit";
}

}  // namespace fpz
