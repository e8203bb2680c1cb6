# Target fpz::gnuplot_iostream: the header gnuplot-iostream.h (which brings no CMake package) and the Boost libraries it
# needs. It starts the program `gnuplot` at run time; nothing here checks that it is installed.
include_guard(GLOBAL)

find_path(GNUPLOT_IOSTREAM_INCLUDE_DIR gnuplot-iostream.h)
mark_as_advanced(GNUPLOT_IOSTREAM_INCLUDE_DIR)
if(NOT GNUPLOT_IOSTREAM_INCLUDE_DIR)
  message(FATAL_ERROR "gnuplot-iostream.h not found: install libgnuplot-iostream-dev or run scripts/setup.sh")
endif()
find_package(Boost CONFIG REQUIRED COMPONENTS iostreams filesystem system)

add_library(fpz_gnuplot_iostream INTERFACE)
add_library(fpz::gnuplot_iostream ALIAS fpz_gnuplot_iostream)
target_include_directories(fpz_gnuplot_iostream SYSTEM INTERFACE "${GNUPLOT_IOSTREAM_INCLUDE_DIR}")
target_link_libraries(fpz_gnuplot_iostream INTERFACE Boost::iostreams Boost::filesystem Boost::system)
