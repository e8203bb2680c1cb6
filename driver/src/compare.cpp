#include "fpz/driver/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string_view>

#include "fpz/driver/history.hpp"
#include "fpz/driver/path_file.hpp"

namespace fpz::driver {
namespace {

constexpr double same_time = 1e-9;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

enum class Kind { stress, energy, damage, jump, strain, ignored };

/// The name in history.csv of a reference's column; empty when it is none of ours.
std::string our_name(const std::string& name) {
  static const std::map<std::string, std::string, std::less<>> aliases = {
      {"T", "time"},     {"sxx", "sig_xx"}, {"syy", "sig_yy"}, {"szz", "sig_zz"}, {"sxy", "sig_xy"},
      {"sxz", "sig_xz"}, {"syz", "sig_yz"}, {"tn", "t_n"},     {"ts1", "t_s1"},   {"ts2", "t_s2"},
      {"un", "u_n"},     {"us1", "u_s1"},   {"us2", "u_s2"}};
  const auto alias = aliases.find(name);
  if (alias != aliases.end()) return alias->second;
  return find_column(name) ? name : std::string();
}

Kind kind_of(std::string_view name) {
  if (name.starts_with("sig_") || name.starts_with("t_")) return Kind::stress;
  if (name.starts_with("energy_")) return Kind::energy;
  if (name == "D" || name == "cracked" || name.starts_with("n_")) return Kind::damage;
  if (name.starts_with("u_") || name.starts_with("up_")) return Kind::jump;
  if (name.starts_with("eps_")) return Kind::strain;
  return Kind::ignored;  // counters, time and text
}

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

/// Scale and tolerance of each kind of column.
class Scales {
 public:
  Scales(const io::Table& reference, const CompareOptions& options) : options_(options) {
    for (std::size_t k = 0; k < reference.names.size(); ++k) {
      double& scale = scale_[kind_of(our_name(reference.names[k]))];
      scale = std::max(scale, largest(reference.columns[k]));
    }
    if (options.stress_scale > 0.0) scale_[Kind::stress] = options.stress_scale;
    scale_[Kind::damage] = 1.0;
  }
  [[nodiscard]] double scale(Kind kind) const {
    const auto found = scale_.find(kind);
    return found == scale_.end() || found->second == 0.0 ? 1.0 : found->second;
  }
  [[nodiscard]] double tolerance(Kind kind) const {
    switch (kind) {
      case Kind::damage:
        return options_.damage_tolerance;
      case Kind::jump:
        return options_.jump_tolerance;
      case Kind::strain:
        return options_.strain_tolerance;
      default:
        return options_.stress_tolerance;
    }
  }

 private:
  const CompareOptions& options_;
  std::map<Kind, double> scale_;
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
    const std::string name = our_name(reference.names[k]);
    if (name.empty()) {
      out.problems.push_back("column \"" + reference.names[k] + "\" of the reference is unknown");
      continue;
    }
    const Kind kind = kind_of(name);
    if (kind == Kind::ignored) continue;
    const std::vector<double>* ours = history.find(name);
    if (!ours) ours = history.find(reference.names[k]);  // two references against each other
    if (!ours) {
      out.problems.push_back("column \"" + name + "\" is missing in " + history.origin);
      continue;
    }
    ColumnDifference d = compare_column(name, *ours, reference.columns[k], times, places, scales.scale(kind));
    d.tolerance = scales.tolerance(kind);
    out.columns.push_back(std::move(d));
  }
  return out;
}

}  // namespace fpz::driver
