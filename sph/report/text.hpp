// Numbers, verdicts and tables in Markdown.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "results.hpp"

namespace fpz::report {

/// With so many digits after the point; "-" for NaN.
[[nodiscard]] std::string fixed(double x, int digits);
/// 0.0123 as "+1.2 %"; "-" for NaN.
[[nodiscard]] std::string deviation(double x, int digits = 1);
[[nodiscard]] std::string percent(double x, int digits = 1);
/// "yes" or "**NO**".
[[nodiscard]] std::string verdict(bool met);

using Row = std::vector<std::string>;
void write_table(std::ostream& out, const Row& header, const std::vector<Row>& rows);

/// One line on how much of a sweep there is; nothing when all its runs have finished. False when there is none.
bool write_state(std::ostream& out, const SweepRuns& sweep, const std::string& what);

}  // namespace fpz::report
