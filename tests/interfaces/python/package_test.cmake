# Installs the package to a fresh prefix; the module and the examples are used from there, and nothing else is on the
# path.
cmake_minimum_required(VERSION 3.25)
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")

execute_process(COMMAND "${CMAKE_COMMAND}" --install "${FPZ_BINARY_DIR}" --config "${CONFIG}" --prefix "${prefix}"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
set(package "${prefix}/${PYTHON_DIR}/fpz")
foreach(file IN ITEMS py.typed _core.pyi)
  if(NOT EXISTS "${package}/${file}")
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
set(ENV{PYTHONPATH} "${prefix}/${PYTHON_DIR}")
execute_process(COMMAND "${PYTHON}" -c "import fpz; print(fpz.__version__, fpz.__file__)"
  WORKING_DIRECTORY "${WORK_DIR}" OUTPUT_VARIABLE out COMMAND_ERROR_IS_FATAL ANY)
string(STRIP "${out}" out)
if(NOT out STREQUAL "${VERSION} ${package}/__init__.py")
  message(FATAL_ERROR "another module was imported: ${out}")
endif()

set(libraries "${prefix}/${LIBRARY_DIR}")
execute_process(COMMAND "${CXX_COMPILER}" -std=c++20 -O1 -fopenmp "-I${prefix}/include" "-isystem" "${EIGEN}"
    "${prefix}/share/fpz/examples/notched_beam.cpp" "-L${libraries}" -lfpz_model -o notched_beam
  WORKING_DIRECTORY "${WORK_DIR}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK_DIR}/notched_beam" 0.008 beam.csv
  WORKING_DIRECTORY "${WORK_DIR}" OUTPUT_VARIABLE out COMMAND_ERROR_IS_FATAL ANY)
if(NOT out MATCHES "elements of 8 mm: peak 25[0-9][0-9]\\.")
  message(FATAL_ERROR "the beam prints\n${out}")
endif()
