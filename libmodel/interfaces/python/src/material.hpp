// fpz.Material: parameters, setting and integration, checked once and never changed.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "fpz/point/behaviour.hpp"

namespace fpz::python {

namespace py = pybind11;

struct PyMaterial {
  std::string name;
  point::Behaviour behaviour;
  std::vector<std::string> notes;     ///< which parameters follow from other quantities
  std::vector<std::string> warnings;  ///< what is doubtful

  [[nodiscard]] int dim() const { return behaviour.setting == Setting::three_d ? 3 : 2; }
};

/// Points share a material, which nothing changes.
using MaterialHandle = std::shared_ptr<PyMaterial>;

/// Calls f with std::integral_constant<int, 2 or 3>.
template <class F>
decltype(auto) with_dim(int dim, F&& f) {
  if (dim == 3) return f(std::integral_constant<int, 3>{});
  return f(std::integral_constant<int, 2>{});
}

void add_material(py::module_& m);
void add_point(py::module_& m);
void add_batch(py::module_& m);
void add_onset(py::module_& m);

}  // namespace fpz::python
