#include <cmath>
#include <set>
#include <stdexcept>

#include "fpz/calibration/fit.hpp"
#include "words.hpp"

namespace fpz::calibration {
namespace {

using detail::number;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

void require_valid(const FitParameter& p) {
  const std::string who = "parameter " + p.name;
  if (p.name.empty()) refuse("a parameter has no name");
  if (!std::isfinite(p.lower)) refuse(who + ": lower = " + number(p.lower) + ": must be finite");
  if (!std::isfinite(p.upper)) refuse(who + ": upper = " + number(p.upper) + ": must be finite");
  if (!std::isfinite(p.start)) refuse(who + ": start = " + number(p.start) + ": must be finite");
  if (!(p.lower < p.upper)) refuse(who + ": lower = " + number(p.lower) + ": must be < upper = " + number(p.upper));
  if (p.start < p.lower || p.start > p.upper) {
    refuse(who + ": start = " + number(p.start) + ": must lie within the bounds " + number(p.lower) + " ... " +
           number(p.upper));
  }
  if (!p.prior) return;
  if (!std::isfinite(p.prior->mean)) refuse(who + ": prior mean = " + number(p.prior->mean) + ": must be finite");
  if (!std::isfinite(p.prior->deviation) || p.prior->deviation <= 0.0) {
    refuse(who + ": prior deviation = " + number(p.prior->deviation) + ": must be finite and > 0");
  }
}

void require_valid(const Observations& data) {
  const std::string who = "data set " + data.name;
  if (data.name.empty()) refuse("a data set has no name");
  if (data.measured.size() == 0) refuse(who + ": no measured values");
  if (data.deviation.size() != data.measured.size()) {
    refuse(who + ": " + std::to_string(data.deviation.size()) + " deviations for " +
           std::to_string(data.measured.size()) + " measured values");
  }
  for (Eigen::Index i = 0; i < data.measured.size(); ++i) {
    const std::string point = " of point " + std::to_string(i + 1);
    if (!std::isfinite(data.measured[i])) {
      refuse(who + ": measured value" + point + " = " + number(data.measured[i]) + ": must be finite");
    }
    if (!std::isfinite(data.deviation[i]) || data.deviation[i] <= 0.0) {
      refuse(who + ": standard deviation" + point + " = " + number(data.deviation[i]) + ": must be finite and > 0");
    }
  }
  if (!std::isfinite(data.weight) || data.weight <= 0.0) {
    refuse(who + ": weight = " + number(data.weight) +
           ": must be finite and > 0; leave the set out instead of weight 0");
  }
  if (data.loss.kind != LossKind::none && (!std::isfinite(data.loss.scale) || data.loss.scale <= 0.0)) {
    refuse(who + ": scale of the robust loss = " + number(data.loss.scale) + ": must be finite and > 0");
  }
  if (!data.forward) refuse(who + ": no forward model");
}

}  // namespace

void require_valid(const FitProblem& problem) {
  if (problem.parameters.empty()) refuse("no parameter to fit");
  if (problem.data.empty()) refuse("no data set");
  std::set<std::string> names;
  Eigen::Index values = 0;
  for (const FitParameter& p : problem.parameters) {
    require_valid(p);
    if (!names.insert(p.name).second) refuse("parameter " + p.name + ": named twice");
    if (p.prior) ++values;
  }
  names.clear();
  for (const Observations& data : problem.data) {
    require_valid(data);
    if (!names.insert(data.name).second) refuse("data set " + data.name + ": named twice");
    values += data.measured.size();
  }
  if (values < static_cast<Eigen::Index>(problem.parameters.size())) {
    refuse(std::to_string(values) + " measured values and priors cannot determine " +
           std::to_string(problem.parameters.size()) + " parameters: fix some, give priors or add data");
  }
}

}  // namespace fpz::calibration
