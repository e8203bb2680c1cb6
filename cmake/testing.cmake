find_package(GTest REQUIRED)
include(GoogleTest)

# fpz_compile_quickly(<target>): for the tests' own code, which compiles a fifth faster this way; what is tested is
# optimised as always. At -O1 g++ 12 reports uninitialised values inside Eigen expressions that are not there.
function(fpz_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endfunction()

# fpz_add_test(<name> SOURCES <file>... [LIBS <target>...] [LABELS <label>...])
# One GoogleTest executable; each of its cases becomes a ctest entry "<name>/<Suite>.<Case>". Links fpz::model and
# GTest::gtest_main. FPZ_SOURCE_DIR and FPZ_DATA_DIR are defined as paths for the sources.
function(fpz_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBS;LABELS")
  if(NOT arg_SOURCES)
    message(FATAL_ERROR "fpz_add_test(${name}): no SOURCES")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "fpz_add_test(${name}): unknown arguments: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE fpz::model ${arg_LIBS} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    FPZ_SOURCE_DIR="${PROJECT_SOURCE_DIR}" FPZ_DATA_DIR="${PROJECT_SOURCE_DIR}/data")
  fpz_set_warnings(${name})
  fpz_compile_quickly(${name})
  set(properties)
  if(arg_LABELS)
    string(REPLACE ";" "\\;" labels "${arg_LABELS}")
    set(properties PROPERTIES LABELS "${labels}")
  endif()
  gtest_discover_tests(${name} NO_PRETTY_VALUES TEST_PREFIX "${name}/" DISCOVERY_MODE PRE_TEST ${properties})
endfunction()
