// What the long runs have in common: they go without the interpreter's lock, tell how far they are, and stop at Ctrl-C.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace fpz::python {

namespace py = pybind11;

/// Looks after Python while a run goes on without its lock.
class Watch {
 public:
  /// `progress` is a callable or None.
  explicit Watch(const py::object& progress) : progress_(progress) {}

  /// Now and then: raises what signals have left (KeyboardInterrupt), and calls progress(info) with the dictionary that
  /// `info()` makes; what that raises goes through.
  template <class Info>
  void look(Info&& info) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < period) return;
    last_ = now;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress_.is_none()) progress_(info());
  }

 private:
  static constexpr std::chrono::milliseconds period{100};
  const py::object& progress_;  ///< of the caller, who has the lock when it ends
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Rows of numbers as an array of records.
[[nodiscard]] py::array records(const std::vector<std::string>& names, const std::vector<double>& values);

void add_paths(py::module_& m);
void add_calibrations(py::module_& m);
void add_scenes(py::module_& m);

}  // namespace fpz::python
