# Installs the package to a fresh prefix and compiles and runs the examples with nothing but it and pkg-config; then once
# more from CMake.
cmake_minimum_required(VERSION 3.25)
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")

function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY "${WORK_DIR}" OUTPUT_VARIABLE out COMMAND_ERROR_IS_FATAL ANY)
  set(out "${out}" PARENT_SCOPE)
endfunction()

run("${CMAKE_COMMAND}" --install "${FPZ_BINARY_DIR}" --config "${CONFIG}" --prefix "${prefix}")
file(GLOB_RECURSE pc "${prefix}/fpz.pc")
cmake_path(GET pc PARENT_PATH pc_folder)
set(ENV{PKG_CONFIG_PATH} "${pc_folder}")
run("${PKG_CONFIG}" --cflags --libs fpz)
string(STRIP "${out}" flags)
separate_arguments(flags)
run("${PKG_CONFIG}" --variable=libdir fpz)
string(STRIP "${out}" library_folder)
run("${PKG_CONFIG}" --variable=fortran_module fpz)
string(STRIP "${out}" module)
set(ENV{LD_LIBRARY_PATH} "${library_folder}")

set(examples "${prefix}/share/fpz/examples")
run("${C_COMPILER}" -std=c99 "${examples}/tension.c" ${flags} -o tension_c)
run("${WORK_DIR}/tension_c")
set(of_c "${out}")
run("${FORTRAN_COMPILER}" "${module}" "${examples}/tension.f90" ${flags} -o tension_f90)
run("${WORK_DIR}/tension_f90")
set(of_fortran "${out}")

run("${FORTRAN_COMPILER}" "${examples}/umat_tension.f90" "-L${library_folder}" -lfpz_umat -o umat_tension)
run("${WORK_DIR}/umat_tension")
set(of_umat "${out}")

file(WRITE "${WORK_DIR}/project/CMakeLists.txt" "
cmake_minimum_required(VERSION 3.25)
project(outside LANGUAGES C CXX)
find_package(fpz 0.1 CONFIG REQUIRED)
add_executable(tension \"${examples}/tension.c\")
target_link_libraries(tension PRIVATE fpz::c)
")
run("${CMAKE_COMMAND}" -S project -B build "-DCMAKE_PREFIX_PATH=${prefix}" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
  "-DCMAKE_BUILD_TYPE=${CONFIG}" "-DCMAKE_C_COMPILER=${C_COMPILER}")
run("${CMAKE_COMMAND}" --build build --config "${CONFIG}")
run("${WORK_DIR}/build/tension")

# The last row: strain, stress, damage.
foreach(text IN ITEMS "${of_c}" "${of_fortran}" "${of_umat}" "${out}")
  if(NOT text MATCHES "0\\.0100 +67037[.0-9]* +0\\.88827\n$")
    message(FATAL_ERROR "unexpected table:\n${text}")
  endif()
endforeach()
