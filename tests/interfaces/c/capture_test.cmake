# A failing update of the C interface writes itself down, and the driver replays it.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../../support/program.cmake")

execute_process(COMMAND "${C_PROGRAM}" "${WORK}/captures" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB captures "${WORK}/captures/fpz-*.json")
list(LENGTH captures count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "not one capture: ${captures}")
endif()
expect(1 "snap_back, 0 iterations, 0 substeps (as captured)" replay "${captures}")
