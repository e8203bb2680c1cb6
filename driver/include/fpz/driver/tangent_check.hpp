// Checks the consistent tangent along a loading path against differences of the update.
#pragma once

#include <string>

#include "fpz/driver/path_file.hpp"

namespace fpz::driver {

struct TangentCheckOptions {
  double tolerance = 1e-5;  ///< on |C - C_differences| / |C|, Frobenius norms
  int every = 1;            ///< check every so many steps
};

struct TangentCheck {
  long checked = 0;
  long kinks = 0;      ///< steps with columns at a kink: one-sided differences disagree, no tangent to judge there
  long failures = 0;   ///< steps above the tolerance
  double worst = 0.0;  ///< largest relative error without the columns at a kink
  double worst_time = 0.0;
  std::string run_status = "ok";  ///< of the path itself
  std::string run_message;
  [[nodiscard]] bool ok() const { return failures == 0 && checked > 0 && run_status == "ok"; }
  [[nodiscard]] std::string report(const TangentCheckOptions& options) const;
};

[[nodiscard]] TangentCheck check_tangent(const Test& test, const TangentCheckOptions& options);

}  // namespace fpz::driver
