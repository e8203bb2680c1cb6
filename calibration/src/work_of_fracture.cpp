#include "fpz/calibration/work_of_fracture.hpp"

#include <algorithm>
#include <cmath>

namespace fpz::calibration {
namespace {

WorkOfFracture no_value(const std::string& why) {
  WorkOfFracture out;
  out.failure = why;
  return out;
}

/// Deflection per load on the way to half of the peak.
double first_compliance(const Eigen::VectorXd& deflection, const Eigen::VectorXd& load) {
  Eigen::Index top = 0;
  const double peak = load.maxCoeff(&top);
  Eigen::Index k = 0;
  while (k < top && load[k] < 0.5 * peak) ++k;
  return deflection[k] / load[k];
}

}  // namespace

WorkOfFracture work_of_fracture(const Eigen::VectorXd& deflection, const Eigen::VectorXd& load, double ligament_area,
                                double weight) {
  const Eigen::Index n = load.size();
  if (n < 4 || deflection.size() != n) return no_value("a curve of at least four points is needed");
  if (!std::is_sorted(deflection.begin(), deflection.end())) return no_value("the deflections must grow");
  const double peak = load.maxCoeff();
  if (!(peak > 0.0) || !(ligament_area > 0.0) || !(weight >= 0.0)) {
    return no_value("loads and ligament must be positive, and the weight not negative");
  }
  const double end_load = std::max(0.0, load[n - 1]);
  if (end_load > 0.5 * peak) return no_value("the curve ends above half of its peak: most of the work is not in it");
  if (load[0] > 0.2 * peak) return no_value("the curve begins above a fifth of its peak: the rise is not in it");
  WorkOfFracture out;
  out.measured = 0.5 * load[0] * deflection[0];
  for (Eigen::Index k = 1; k < n; ++k) {
    out.measured += 0.5 * (load[k] + load[k - 1]) * (deflection[k] - deflection[k - 1]);
  }
  const double end = deflection[n - 1];
  const double hinge = end - first_compliance(deflection, load) * end_load;
  out.weight = 0.5 * weight * end;
  out.tail = end_load * hinge + 0.5 * weight * end;
  out.energy = (out.measured + out.weight + out.tail) / ligament_area;
  return out;
}

}  // namespace fpz::calibration
