# FPZ_WITH_PYTHON: whether the Python module can be built, and then Python::Interpreter, Python::NumPy and
# pybind11_add_module(). The Python is the system's (/usr/bin/python3), whose numpy and pybind11 are packages, whatever
# other one comes first on PATH; -DPython_EXECUTABLE=... takes another.
include_guard(GLOBAL)

set(FPZ_WITH_PYTHON OFF)
if(FPZ_SANITIZE)
  message(STATUS "No Python module: a sanitizer's run-time library would have to be in the interpreter")
  return()
endif()
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python for which the module fpz is built")
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy OPTIONAL_COMPONENTS Development.Embed)
find_package(pybind11 2.10 CONFIG QUIET)
if(Python_FOUND AND pybind11_FOUND)
  set(FPZ_WITH_PYTHON ON)
else()
  message(STATUS "No Python module: it needs python3-dev, python3-numpy and pybind11-dev (scripts/setup.sh)")
endif()
