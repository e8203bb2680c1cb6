#include "fpz/driver/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "fpz/driver/history.hpp"
#include "fpz/driver/path_file.hpp"

namespace fpz::driver {
namespace {

constexpr double same_time = 1e-9;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Where the history has a time of the reference.
struct Place {
  std::size_t row = 0;
  double weight = 0.0;  ///< of row + 1; 0: the row's own time
  bool found = false;
};

Place find_place(const std::vector<double>& times, double t) {
  Place place;
  const auto after = std::lower_bound(times.begin(), times.end(), t - same_time);
  if (after == times.end()) return place;
  place.row = static_cast<std::size_t>(after - times.begin());
  if (std::abs(*after - t) <= same_time) {
    place.found = true;
  } else if (after != times.begin()) {
    --place.row;
    place.weight = (t - times[place.row]) / (*after - times[place.row]);
    place.found = true;
  }
  return place;
}

double value_at(const std::vector<double>& column, const Place& place) {
  const double a = column[place.row];
  return place.weight == 0.0 ? a : a + place.weight * (column[place.row + 1] - a);
}

double largest(const std::vector<double>& column) {
  double m = 0.0;
  for (const double x : column) m = std::max(m, std::isfinite(x) ? std::abs(x) : 0.0);
  return m;
}

/// Scale and tolerance of each quantity.
class Scales {
 public:
  Scales(const io::Table& reference, const CompareOptions& options) : options_(options) {
    for (std::size_t k = 0; k < reference.names.size(); ++k) {
      const Column* column = find_column_or_alias(reference.names[k]);
      if (column == nullptr) continue;
      double& scale = scale_[column->quantity];
      scale = std::max(scale, largest(reference.columns[k]));
    }
    if (options.stress_scale > 0.0) scale_[Quantity::stress] = options.stress_scale;
    scale_[Quantity::fraction] = 1.0;
  }
  [[nodiscard]] double scale(Quantity quantity) const {
    const auto found = scale_.find(quantity);
    return found == scale_.end() || found->second == 0.0 ? 1.0 : found->second;
  }
  [[nodiscard]] double tolerance(Quantity quantity) const {
    switch (quantity) {
      case Quantity::fraction:
        return options_.damage_tolerance;
      case Quantity::jump:
        return options_.jump_tolerance;
      case Quantity::strain:
        return options_.strain_tolerance;
      default:
        return options_.stress_tolerance;
    }
  }

 private:
  const CompareOptions& options_;
  std::map<Quantity, double> scale_;
};

ColumnDifference compare_column(const std::string& name, const std::vector<double>& ours,
                                const std::vector<double>& theirs, const std::vector<double>& times,
                                const std::vector<Place>& places, double scale) {
  ColumnDifference d;
  d.difference = -1.0;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    if (!places[i].found) continue;
    const double value = value_at(ours, places[i]);
    const double difference = std::abs(value - theirs[i]);
    if (std::isfinite(difference) && difference <= d.difference) continue;
    d = {name,  difference, std::isfinite(difference) ? difference / scale : not_a_number, 0.0, times[i],
         value, theirs[i]};
    if (!std::isfinite(difference)) break;
  }
  d.column = name;
  d.difference = std::max(d.difference, 0.0);
  return d;
}

const std::vector<double>& times_of(const io::Table& table) {
  const auto* time = table.find("time");
  return time ? *time : table.at("T");
}

}  // namespace

bool Comparison::ok() const {
  return problems.empty() && !columns.empty() &&
         std::all_of(columns.begin(), columns.end(), [](const auto& c) { return c.ok(); });
}

std::string Comparison::report() const {
  char line[240];
  std::snprintf(line, sizeof line, "%-18s %13s %13s %10s %12s %24s %24s\n", "column", "difference", "relative",
                "tolerance", "at time", "value", "reference");
  std::string text = line;
  for (const ColumnDifference& c : columns) {
    std::snprintf(line, sizeof line, "%-18s %13.4g %13.4g %10.3g %12.6g %24.16g %24.16g%s\n", c.column.c_str(),
                  c.difference, c.relative, c.tolerance, c.time, c.value, c.reference, c.ok() ? "" : "  <-- FAILS");
    text += line;
  }
  text += std::to_string(rows) + " rows compared";
  if (interpolated > 0)
    text += "; " + std::to_string(interpolated) + " of them have no equal time in the history and were interpolated";
  text += "\n";
  for (const std::string& p : problems) text += "error: " + p + "\n";
  return text + (ok() ? "ok\n" : "DIFFERENT\n");
}

Comparison compare_histories(const io::Table& history, const io::Table& reference, const CompareOptions& options) {
  Comparison out;
  const std::vector<double>& times = times_of(reference);
  const std::vector<double>& our_times = times_of(history);
  if (!std::is_sorted(our_times.begin(), our_times.end())) throw InputError(history.origin + ": times do not increase");
  std::vector<Place> places;
  for (const double t : times) {
    places.push_back(std::isfinite(t) ? find_place(our_times, t) : Place());
    if (!places.back().found) {
      out.problems.push_back("time " + std::to_string(t) + " of the reference is outside the history");
      break;
    }
    ++out.rows;
    if (places.back().weight != 0.0) ++out.interpolated;
  }
  places.resize(times.size());
  const Scales scales(reference, options);
  for (std::size_t k = 0; k < reference.names.size(); ++k) {
    const Column* column = find_column_or_alias(reference.names[k]);
    if (column == nullptr) {
      out.problems.push_back("column \"" + reference.names[k] + "\" of the reference is unknown");
      continue;
    }
    if (column->quantity == Quantity::count) continue;
    const std::string name(column->name);
    const std::vector<double>* ours = history.find(name);
    if (!ours) ours = history.find(reference.names[k]);  // two references against each other
    if (!ours) {
      out.problems.push_back("column \"" + name + "\" is missing in " + history.origin);
      continue;
    }
    ColumnDifference d =
        compare_column(name, *ours, reference.columns[k], times, places, scales.scale(column->quantity));
    d.tolerance = scales.tolerance(column->quantity);
    out.columns.push_back(std::move(d));
  }
  return out;
}

}  // namespace fpz::driver
