// Fits to laboratory data.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "errors.hpp"
#include "fpz/calibration/calibration.hpp"
#include "fpz/calibration/report.hpp"
#include "fpz/io/output.hpp"
#include "running.hpp"

namespace fpz::python {

namespace {

namespace cal = fpz::calibration;

cal::Specification read(const std::optional<std::string>& text, const std::string& file) {
  if (!text) return cal::read_specification(file);
  return saying_no_line(file, [&] { return cal::parse_specification(*text, file); });
}

/// The points of a data set with what the fitted material predicts there.
py::array curve_of(const cal::DataSet& set, const cal::Comparison& c) {
  const std::vector<std::string> names = {"abscissa", "measured", "deviation", "predicted", "band", "residual"};
  std::vector<double> values;
  const auto at = [](const Eigen::VectorXd& v, Eigen::Index k) {
    return k < v.size() ? v[k] : std::numeric_limits<double>::quiet_NaN();
  };
  for (Eigen::Index k = 0; k < set.measured.size(); ++k) {
    for (const Eigen::VectorXd* v : {&set.abscissa, &set.measured, &c.deviation, &c.predicted, &c.band, &c.residuals}) {
      values.push_back(at(*v, k));
    }
  }
  return records(names, values);
}

py::dict result_of(const cal::Calibration& c) {
  py::dict d, curves;
  for (const cal::Comparison& one : c.comparisons) {
    const cal::DataSet& set = c.specification.data[one.data_set];
    curves[py::str(set.name)] = curve_of(set, one);
  }
  d["name"] = c.specification.name;
  d["status"] = to_string(c.result.status);
  d["message"] = c.result.message;
  d["material"] = cal::material_json(c);
  d["report"] = cal::report_json(c);
  d["curves"] = curves;
  d["warnings"] = c.warnings;
  d["notes"] = c.specification.conversions;
  return d;
}

py::dict calibrate(const std::optional<std::string>& text, const std::string& file, const py::object& progress,
                   int starts, const std::optional<std::filesystem::path>& out, bool force, bool pictures) {
  cal::Specification spec = read(text, file);
  if (starts > 0) spec.options.starts = starts;
  if (out) {
    io::make_writable_folder(*out);  // before the work, not after it
    io::require_absent(cal::report_files(spec, *out, pictures), force);
  }
  cal::Calibration result;
  Watch watch(progress);
  {
    const py::gil_scoped_release others_may_run;
    result = cal::calibrate(spec, [&](const cal::FitProgress& p) {
      watch.look([&] {
        py::dict d;
        d["name"] = spec.name;
        d["stage"] = p.stage;
        d["fraction"] = p.fraction;
        d["cost"] = p.cost;
        return d;
      });
    });
  }
  for (std::string& w : result.warnings) {
    if (text) w = without_line(w, file);
  }
  warn(result.warnings);
  if (out) {
    const cal::ReportFiles written = cal::write_report(result, {*out, force, pictures, {}});
    warn(written.warnings);
  }
  return result_of(result);
}

}  // namespace

void add_calibrations(py::module_& m) {
  m.def("_calibrate", &calibrate, py::arg("text"), py::arg("file"), py::arg("progress"), py::arg("starts"),
        py::arg("out"), py::arg("force"), py::arg("pictures"), "Fits a material: fpz.calibrate().");
}

}  // namespace fpz::python
