// Calls through the Python module, in an interpreter inside the benchmark: loops in Python over calls of fpz.
#pragma once

#include <pybind11/embed.h>
#include <pybind11/numpy.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "fpz/law/softening.hpp"
#include "fpz/state.hpp"

namespace fpz::bench {

/// Every job holds the interpreter that it runs in.
class PythonModule {
 public:
  /// `folder` is the one with the package fpz.
  PythonModule(const std::string& folder, const Parameters& parameters) {
    namespace py = pybind11;
    static const py::scoped_interpreter interpreter;
    py::module_::import("sys").attr("path").attr("insert")(0, folder);
    py::module_::import("warnings").attr("simplefilter")("ignore");
    py::dict keys;
    for (const ParameterInfo<double>& p : parameter_table<double>)
      keys[py::str(std::string(p.name))] = parameters.*p.member;
    visit_choices(parameters.choices, [&keys](const char* key, auto choice) { keys[key] = to_string(choice); });
    py::dict names;
    names["fpz"] = py::module_::import("fpz");
    names["keys"] = keys;
    py::exec(R"(
rock = fpz.Material(**keys)

def batch(begin, increments, tangents):
    end, stiffness = begin.copy(), rock.fresh_tangents(len(begin)) if tangents else None
    def run(calls):
        for _ in range(calls):
            fpz.update_batch(rock, begin, increments, end, stiffness, threads=1)
    return run

def walk(state, there, back):
    point = fpz.Point(rock)
    point.state = state
    def run(calls):
        for _ in range(calls // 2):
            point.update(there)
            point.update(back)
    return run
)",
             names);
    names_ = names;
  }

  /// A batch of these points, into an array of its own.
  [[nodiscard]] std::function<void(int)> batch(const std::vector<State2>& states, const Tensor<double, 2>& increment,
                                               bool tangents) const {
    namespace py = pybind11;
    const auto count = static_cast<py::ssize_t>(states.size());
    py::array_t<double> increments({count, py::ssize_t{3}});
    for (py::ssize_t k = 0; k < count; ++k) {
      for (int i = 0; i < 3; ++i) increments.mutable_at(k, i) = increment[i];
    }
    return job(names_["batch"](records(states), increments, tangents));
  }

  /// A point there and back.
  [[nodiscard]] std::function<void(int)> walk(const State2& begin, const Tensor<double, 2>& increment) const {
    namespace py = pybind11;
    const Tensor<double, 2> back = -increment;
    return job(names_["walk"](records({begin})[py::int_(0)], py::array_t<double>(3, increment.data()),
                              py::array_t<double>(3, back.data())));
  }

 private:
  [[nodiscard]] pybind11::array records(const std::vector<State2>& states) const {
    const pybind11::array all = names_["rock"].attr("fresh_states")(states.size());
    std::memcpy(const_cast<void*>(all.data()), static_cast<const void*>(states.data()), states.size() * sizeof(State2));
    return all;
  }

  static std::function<void(int)> job(const pybind11::object& run) {
    return [run](int calls) { run(calls); };
  }

  pybind11::object names_;  ///< globals of the script
};

}  // namespace fpz::bench
