#include "fpz/sph/time_table.hpp"

#include <cmath>

namespace fpz::sph {

std::string problem_of(const TimeTable& t) {
  if (t.time.empty()) return "has no times";
  if (t.time.size() != t.value.size()) return "must have a value for each time";
  for (std::size_t k = 0; k < t.time.size(); ++k) {
    if (!std::isfinite(t.time[k]) || !std::isfinite(t.value[k])) return "must be finite";
    if (k > 0 && !(t.time[k] > t.time[k - 1])) return "must have ascending times";
  }
  return std::isfinite(t.start) ? "" : "must have a finite start";
}

}  // namespace fpz::sph
