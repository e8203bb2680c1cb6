#include "text.hpp"

#include <cmath>
#include <cstdio>

namespace fpz::report {

std::string fixed(double x, int digits) {
  if (!std::isfinite(x)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, x);
  return text;
}

std::string deviation(double x, int digits) {
  if (!std::isfinite(x)) return "-";
  std::string text = x < 0.0 ? "-" : "+";
  text += fixed(std::abs(100.0 * x), digits) + " %";
  return text;
}

std::string percent(double x, int digits) { return std::isfinite(x) ? fixed(100.0 * x, digits) + " %" : "-"; }

std::string verdict(bool met) { return met ? "yes" : "**NO**"; }

void write_table(std::ostream& out, const Row& header, const std::vector<Row>& rows) {
  const auto line = [&](const Row& row) {
    out << "|";
    for (const std::string& cell : row) out << " " << cell << " |";
    out << "\n";
  };
  out << "\n";
  line(header);
  line(Row(header.size(), "---"));
  for (const Row& row : rows) line(row);
  out << "\n";
}

bool write_state(std::ostream& out, const SweepRuns& sweep, const std::string& what) {
  if (sweep.planned == 0) {
    out << "\n" << what << ": **not run**.\n";
    return false;
  }
  std::string failed;
  for (const Run& r : sweep.runs) {
    if (!r.finished()) failed += "\n- `" + r.series + "`, " + r.label + ": " + r.reason();
  }
  if (sweep.runs.size() < sweep.planned) {
    out << "\n" << what << ": " << sweep.runs.size() << " of " << sweep.planned << " runs have ended.\n";
  }
  if (!failed.empty()) out << "\n" << what << ", runs that failed:\n" << failed << "\n\n";
  return !sweep.runs.empty();
}

}  // namespace fpz::report
