// The compiled part of the Python module fpz. What a person imports is in fpz/__init__.py.
#include "errors.hpp"
#include "material.hpp"
#include "running.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace fpz::python;
  m.doc() = "Compiled part of fpz: import fpz instead.";
  m.attr("__version__") = FPZ_VERSION;
  register_errors();
  add_material(m);
  add_point(m);
  add_batch(m);
  add_onset(m);
#ifdef FPZ_PYTHON_DRIVER
  add_paths(m);
#endif
#ifdef FPZ_PYTHON_CALIBRATION
  add_calibrations(m);
#endif
#ifdef FPZ_PYTHON_SPH
  add_scenes(m);
#endif
}
