# An example in MTest: it holds, and does not for another material. Called by ctest, see CMakeLists.txt.
cmake_minimum_required(VERSION 3.25)

# run_mtest(<folder> <fails>): whether MTest fails must be <fails>.
function(run_mtest folder fails)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${LIBRARY_FOLDER}:$ENV{LD_LIBRARY_PATH}"
    "${MTEST}" --verbose=quiet "${EXAMPLE}.mtest"
    WORKING_DIRECTORY "${folder}" RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if((result EQUAL 0 AND fails) OR (NOT result EQUAL 0 AND NOT fails))
    string(SUBSTRING "${text}" 0 2000 text)
    message(FATAL_ERROR "mtest returned ${result} in ${folder}:\n${text}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(COPY "${EXAMPLES}/" DESTINATION "${WORK}/right")
run_mtest("${WORK}/right" FALSE)

file(COPY "${EXAMPLES}/" DESTINATION "${WORK}/altered")
file(READ "${EXAMPLES}/${EXAMPLE}.mtest" text)
string(REPLACE "'tensile_strength' 0.6e6" "'tensile_strength' 0.601e6" altered "${text}")
file(WRITE "${WORK}/altered/${EXAMPLE}.mtest" "${altered}")
run_mtest("${WORK}/altered" TRUE)
