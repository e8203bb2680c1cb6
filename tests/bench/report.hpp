// The report: tables and findings from the studies, in Markdown.
#pragma once

#include <iosfwd>

#include "studies.hpp"

namespace fpz::bench {

struct Results {
  std::vector<PathStudy> paths;
  WalkError coarse_implicit;
  std::vector<ToleranceRow> tolerance;
  std::vector<Contender> time_to_error;
  OnsetStudy onset;
  MapStudy maps;
  NewtonStudy newton;
  std::vector<Timing> timings;
  AlternativeStudy alternatives;
};

/// Two digits: 3.1e-6.
[[nodiscard]] std::string sci(double x);

/// The error at which section (c) compares, over sigma_t0.
inline constexpr double target_error = 5e-4;

struct Target {
  std::string what, wanted, reached;
  bool met = false;
};

/// The targets that depend on errors only; `--quick` checks these.
[[nodiscard]] std::vector<Target> accuracy_targets(const Results& r);
[[nodiscard]] std::vector<Target> speed_targets(const Results& r);

void write_report(std::ostream& out, const Results& r);

}  // namespace fpz::bench
