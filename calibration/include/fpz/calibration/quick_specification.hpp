// A specification made from a few arguments: one notched specimen, its lengths and its curve.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fpz/io/csv.hpp"

namespace fpz::calibration {

struct QuickColumn {
  std::string column;  ///< name, or number counted from 1; empty: the one whose name says so
  std::string unit;    ///< empty: the file's
  double scale = 1.0;
};

struct QuickFit {
  std::string kind = "notched_beam";                         ///< or another kind with a "geometry"
  std::filesystem::path data;                                ///< relative to the current folder
  std::string gauge = "cmod";                                ///< what the reading is, as in specifications
  std::vector<std::pair<std::string, std::string>> lengths;  ///< key of the geometry, and "100mm"
  std::optional<double> wedge_half_angle_deg;  ///< of wedge splitting: the load is then the vertical one of the machine
  QuickColumn reading, load;
  std::string young_modulus;  ///< "30GPa"; empty: fitted
  double poisson_ratio = 0.2;
  std::string softening;  ///< empty: the default
  std::string setting = "plane_strain";
  io::CsvOptions table;
};

/// The specification as JSON: Young's modulus (unless stated), tensile strength and delta0 are fitted, what a crack in
/// pure mode I does not depend on is assumed and said so. `folder` is where it will stand, to which the name of the
/// data file is relative. Throws io::InputError for what cannot be read or is not unique, naming the argument that
/// settles it.
[[nodiscard]] std::string quick_specification(const QuickFit& fit, const std::filesystem::path& folder);

}  // namespace fpz::calibration
