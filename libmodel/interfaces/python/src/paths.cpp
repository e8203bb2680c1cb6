// Loading paths of the driver.
#include <pybind11/stl.h>

#include "errors.hpp"
#include "fpz/driver/run.hpp"
#include "running.hpp"

namespace fpz::python {

namespace {

py::array history_of(const driver::History& history) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const std::string_view name : driver::numeric_column_names()) names.emplace_back(name);
  values.reserve(names.size() * history.size());
  for (const driver::Row& row : history) {
    for (const driver::Column& c : driver::columns()) {
      if (c.get != nullptr) values.push_back(c.get(row));
    }
  }
  return records(names, values);
}

py::dict result_of(const driver::Test& test, const driver::Result& result) {
  py::dict d;
  d["name"] = test.name;
  d["status"] = result.status;
  d["message"] = result.message;
  d["history"] = history_of(result.history);
  d["summary"] = driver::to_json(test, result);
  d["warnings"] = result.warnings;
  d["notes"] = test.conversions;
  return d;
}

driver::PathFile read(const std::optional<std::string>& text, const std::string& file) {
  if (!text) return driver::read_path_file(file);
  return saying_no_line(file, [&] { return driver::parse_path_file(*text, file); });
}

py::list run_tests(const std::optional<std::string>& text, const std::string& file, const py::object& progress) {
  const driver::PathFile paths = read(text, file);
  for (const driver::Test& test : paths.tests) {
    std::vector<std::string> warnings;
    for (const std::string& w : test.warnings) warnings.push_back(text ? without_line(w, file) : w);
    warn(warnings);
  }
  py::list results;
  Watch watch(progress);
  for (const driver::Test& test : paths.tests) {
    driver::Result result;
    {
      const py::gil_scoped_release others_may_run;
      result = driver::run_test(test, [&](const driver::Progress& p) {
        watch.look([&] {
          py::dict d;
          d["name"] = test.name;
          d["fraction"] = p.stages > 0 ? p.time / p.stages : 0.0;
          d["damage"] = p.damage;
          return d;
        });
      });
    }
    warn(result.warnings);
    results.append(result_of(test, result));
  }
  return results;
}

}  // namespace

void add_paths(py::module_& m) {
  m.def("_run_tests", &run_tests, py::arg("text"), py::arg("file"), py::arg("progress"),
        "Runs the tests of a path file: fpz.run_path() and fpz.run_paths().");
}

}  // namespace fpz::python
