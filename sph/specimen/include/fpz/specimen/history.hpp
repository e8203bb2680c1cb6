// The rows of history.csv.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fpz::specimen {

struct History {
  std::vector<std::string> columns;
  std::vector<double> values;  ///< row after row

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  /// Index of a column that is known to be there.
  [[nodiscard]] std::size_t column(std::string_view name) const;
  [[nodiscard]] double at(std::size_t row, std::string_view name) const {
    return values[row * columns.size() + column(name)];
  }
  [[nodiscard]] double last(std::string_view name) const { return at(rows() - 1, name); }
  /// All values of a column that is known to be there.
  [[nodiscard]] std::vector<double> all(std::string_view name) const;
  /// Every number in the shortest form that reads back as the same one.
  [[nodiscard]] std::string to_csv() const;
};

/// Work of a load (N) along a way (m) up to `end` (m), J; the last step counts as far as it goes.
[[nodiscard]] double work_until(double end, const std::vector<double>& way, const std::vector<double>& load);

}  // namespace fpz::specimen
