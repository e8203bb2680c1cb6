#include "fpz/calibration/peak_load.hpp"

#include <utility>

#include "admissible.hpp"
#include "fpz/calibration/monotonic_curve.hpp"

namespace fpz::calibration {

Prediction predict(const PeakLoadTest& test, const Parameters& parameters, bool derivatives) {
  const auto n = static_cast<Eigen::Index>(test.specimens.size());
  Prediction out;
  out.values.resize(n);
  if (derivatives) out.jacobian = Eigen::MatrixXd::Zero(n, parameter_count);
  for (Eigen::Index k = 0; k < n; ++k) {
    const PeakLoadSpecimen& s = test.specimens[static_cast<std::size_t>(k)];
    if (const Validation valid = validate(s.specimen); !valid.ok()) return failed(valid.report());
    if (std::string why = why_inadmissible(parameters, s.specimen.setting); !why.empty()) return failed(std::move(why));
    const auto body = s.cache->get(s.specimen, parameters.poisson_ratio, derivatives);
    const MonotonicCurve peak = peak_of_curve(*body, parameters, derivatives);
    if (!peak.failure.empty()) return failed("specimen " + std::to_string(k + 1) + ": " + peak.failure);
    out.values[k] = peak.load[0];
    if (!derivatives) continue;
    for (const auto& [parameter, input] : {std::pair{Parameter::young_modulus, PathInput::young_modulus},
                                           std::pair{Parameter::poisson_ratio, PathInput::poisson_ratio},
                                           std::pair{Parameter::tensile_strength, PathInput::tensile_strength},
                                           std::pair{Parameter::delta0, PathInput::delta0},
                                           std::pair{Parameter::normal_stiffness, PathInput::normal_stiffness}}) {
      out.jacobian(k, static_cast<int>(parameter)) = peak.derivatives(0, static_cast<int>(input));
    }
  }
  return out;
}

std::vector<NotchedSpecimen> peak_specimens(const PeakLoadTest& test) {
  std::vector<NotchedSpecimen> list;
  for (const PeakLoadSpecimen& s : test.specimens) list.push_back(s.specimen);
  return list;
}

}  // namespace fpz::calibration
