// The data sets of a specification: what all have in common, and one reader per kind of test.
#pragma once

#include <filesystem>
#include <optional>

#include "curve_reader.hpp"
#include "fpz/calibration/data_set.hpp"

namespace fpz::calibration::detail {

/// Where a data set stands.
struct SetContext {
  const Context& c;
  std::filesystem::path folder;  ///< of the specification
  Setting setting = Setting::plane_strain;
};

/// A reader of one kind fills in the values, the axes and the model. Problems are recorded; what it leaves is not used
/// then.
using KindReader = void (*)(const SetContext&, const Place& set, DataSet& out);

void read_fracture_energy(const SetContext& s, const Place& set, DataSet& out);
void read_strength(const SetContext& s, const Place& set, DataSet& out);
void read_traction_separation(const SetContext& s, const Place& set, DataSet& out);
void read_stress_strain(const SetContext& s, const Place& set, DataSet& out);
void read_notched_beam(const SetContext& s, const Place& set, DataSet& out);
void read_peak_load(const SetContext& s, const Place& set, DataSet& out);
void read_scene(const SetContext& s, const Place& set, DataSet& out);
void read_semicircular_bend(const SetContext& s, const Place& set, DataSet& out);
void read_compact_tension(const SetContext& s, const Place& set, DataSet& out);
void read_wedge_splitting(const SetContext& s, const Place& set, DataSet& out);
void read_double_cantilever(const SetContext& s, const Place& set, DataSet& out);

/// The data set at `set`; nothing when there is a problem.
[[nodiscard]] std::optional<DataSet> read_data_set(const SetContext& s, const Place& set);

/// Copies the used values and their deviations.
void take_curve(const Curve& curve, std::size_t abscissa, std::size_t measured, DataSet& out);

/// An axis in a unit in which its largest value is easy to read.
[[nodiscard]] Axis readable_axis(const std::string& what, Quantity quantity, double largest);

}  // namespace fpz::calibration::detail
