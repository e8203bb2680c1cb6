#include "fpz/specimen/history.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fpz/io/problems.hpp"

namespace fpz::specimen {

std::size_t History::column(std::string_view name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  if (at == columns.end()) throw std::out_of_range("no column " + std::string(name));
  return static_cast<std::size_t>(at - columns.begin());
}

std::vector<double> History::all(std::string_view name) const {
  std::vector<double> list(rows());
  for (std::size_t k = 0; k < list.size(); ++k) list[k] = at(k, name);
  return list;
}

double work_until(double end, const std::vector<double>& way, const std::vector<double>& load) {
  double work = 0.0;
  for (std::size_t k = 1; k < load.size() && way[k - 1] < end; ++k) {
    work += 0.5 * (load[k] + load[k - 1]) * (std::min(way[k], end) - way[k - 1]);
  }
  return work;
}

std::string History::to_csv() const {
  std::string text;
  for (std::size_t c = 0; c < columns.size(); ++c) text += (c > 0 ? "," : "") + columns[c];
  text += '\n';
  for (std::size_t k = 0; k < values.size(); ++k) {
    text += std::isnan(values[k]) ? "nan" : io::exact(values[k]);
    text += (k + 1) % columns.size() == 0 ? '\n' : ',';
  }
  return text;
}

}  // namespace fpz::specimen
