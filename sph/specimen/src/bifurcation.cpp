#include "fpz/specimen/bifurcation.hpp"

#include <algorithm>
#include <sstream>

namespace fpz::specimen {

std::string warning_of_bifurcation(const std::vector<CrackPath>& longest_first, double spacing) {
  constexpr double part_of_longest = 0.5;
  constexpr double shortest = 6.0;  // spacings
  if (longest_first.empty()) return "";
  const double least = std::max(part_of_longest * longest_first.front().length(), shortest * spacing);
  std::ostringstream lengths;
  int count = 0;
  for (const CrackPath& path : longest_first) {
    if (path.length() < least) break;
    lengths << (count++ == 0 ? "" : ", ") << 1e3 * path.length();
  }
  if (count < 2) return "";
  std::ostringstream s;
  s << count << " cracks of similar length have opened (" << lengths.str()
    << " mm): the specimen has bifurcated, and load, crack area and energies are those of all of them; a notch, or "
       "\"scattered\" particles, which are not symmetric, let one of them lead";
  return s.str();
}

}  // namespace fpz::specimen
