// History of a material point along a loading path: the rows of history.csv.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fpz::driver {

/// One row of history.csv. SI units, tension positive, tensor shear strains.
struct Row {
  int stage = 0;      ///< counts from 1; 0 is the initial state
  int increment = 0;  ///< counts from 1 within the stage
  double time = 0.0;  ///< counts stages: 1.5 is half-way through stage 2
  std::array<double, 6> strain{};
  std::array<double, 6> stress{};  ///< Pa
  bool cracked = false;
  std::array<double, 3> normal{};    ///< of the crack plane; zero when uncracked, as all that follows up to `damage`
  std::array<double, 3> jump{};      ///< local frame (n, s1, s2), m
  double plastic_normal = 0.0;       ///< inelastic opening, m
  double plastic_slip = 0.0;         ///< accumulated inelastic slip, m
  std::array<double, 3> traction{};  ///< local frame, Pa
  double damage = 0.0;
  double stored = 0.0;      ///< J/m^3
  double dissipated = 0.0;  ///< J/m^3
  int iterations = 0;       ///< of the integrator, summed over everything this increment needed
  std::string status = "ok";
  double work = 0.0;  ///< of the stress since the start, trapezoidal rule, J/m^3
};

using History = std::vector<Row>;

/// What a column holds; decides how two histories are compared.
enum class Quantity {
  count,   ///< counters, time and text
  strain,  ///< the components of a tensor
  stress,  ///< or traction
  jump,
  fraction,  ///< of order one: damage, components of unit vectors
  energy
};

/// A column of history.csv. `get` is null for the one column of text, `status`.
struct Column {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  Quantity quantity;
  double (*get)(const Row&);
  std::string_view alias = {};  ///< the name in some reference files
};

/// All columns in the order of the file.
[[nodiscard]] std::span<const Column> columns();

/// The names of those that hold numbers.
[[nodiscard]] std::span<const std::string_view> numeric_column_names();

/// The column of that name, or null.
[[nodiscard]] const Column* find_column(std::string_view name);

/// The same, by its name or its alias.
[[nodiscard]] const Column* find_column_or_alias(std::string_view name);

/// The whole file as text: header line, then one line per row with 17 significant digits.
[[nodiscard]] std::string to_csv(const History& history);

/// Writes history.csv (see output.hpp for how).
void write_history(const std::filesystem::path& file, const History& history, bool force);

}  // namespace fpz::driver
