// What a calibration leaves behind: the material, the report for machines and for people, curves and pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fpz/calibration/calibration.hpp"

namespace fpz::calibration {

/// Text of material.json: complete, with the key "provenance". Its parameters are read by io::read_material_file.
[[nodiscard]] std::string material_json(const Calibration& calibration);

/// Text of report.json; the keys are listed in docs/calibration.md.
[[nodiscard]] std::string report_json(const Calibration& calibration);

/// Text of report.md. Pictures are embedded when `with_pictures`.
[[nodiscard]] std::string report_markdown(const Calibration& calibration, bool with_pictures);

/// Text of the curve of one data set: abscissa, measured, deviation, fitted, band_low, band_high, residual; SI.
[[nodiscard]] std::string curve_csv(const Calibration& calibration, const Comparison& comparison);

/// A few lines for the terminal: status, then value and standard error of every fitted parameter.
[[nodiscard]] std::string short_table(const Calibration& calibration);

struct ReportOptions {
  std::filesystem::path folder;
  bool force = false;             ///< replace files that exist
  bool pictures = true;           ///< needs gnuplot
  std::function<void()> between;  ///< called before every file; may throw to stop
};

struct ReportFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;  ///< pictures that could not be drawn
};

/// The files that write_report() may write.
[[nodiscard]] std::vector<std::filesystem::path> report_files(const Specification& specification,
                                                              const std::filesystem::path& folder, bool pictures);

/// Writes everything into the folder, which is made. When the fit is not usable the material goes to
/// material_unusable.json, and a material.json of an earlier fit is removed (with `force`; without, it is an error).
/// Throws io::OutputError.
ReportFiles write_report(const Calibration& calibration, const ReportOptions& options);

}  // namespace fpz::calibration
