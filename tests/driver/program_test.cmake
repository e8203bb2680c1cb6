# Runs fpz-driver from outside: exit statuses, files, and what happens without gnuplot or with files in the way.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../support/program.cmake")

set(four "${DATA}/paths/four_stage.json")
set(reference "${DATA}/reference/four_stage.csv")

expect(0 "Examples:" --help)
foreach(command run plot check compare replay)
  expect(0 "Example:" ${command} --help)
endforeach()
expect(0 "energy_dissipated" run --help)
expect(2 "" )
expect(2 "" frobnicate)
expect(2 "missing.json" run "${WORK}/missing.json" -o "${WORK}/x")

expect(0 "four_stage: ok" run "${four}" -o "${WORK}/four" --no-plots)
expect(2 "--force" run "${four}" -o "${WORK}/four" --no-plots)
expect(0 "" run "${four}" -o "${WORK}/four" --no-plots --force)
foreach(file history.csv summary.json)
  if(NOT EXISTS "${WORK}/four/${file}")
    message(SEND_ERROR "${file} is missing")
  endif()
endforeach()
file(GLOB left_over "${WORK}/four/.*")
if(left_over)
  message(SEND_ERROR "temporary files are left: ${left_over}")
endif()

expect(0 "ok" compare "${WORK}/four/history.csv" "${reference}" --stress-tolerance 1e-6)
expect(1 "DIFFERENT" compare "${WORK}/four/history.csv" "${reference}" --stress-tolerance 1e-15)
expect(2 "" compare "${WORK}/four/history.csv" "${WORK}/missing.csv")
expect(0 "ok" check "${four}" --every 100)
expect(1 "FAILED" check "${four}" --every 100 --tolerance 1e-20)

# A run that cannot go on leaves its history and says why.
expect(1 "jump_control" run "${DATA}/paths/snap_back.json" -o "${WORK}/snap_back" --no-plots)
if(NOT EXISTS "${WORK}/snap_back/history.csv")
  message(SEND_ERROR "a failed run must leave its history")
endif()

file(WRITE "${WORK}/no_capture.json" "{}")
expect(2 "fpz_capture" replay "${WORK}/no_capture.json")

# A file where the folder should be.
file(WRITE "${WORK}/file" "")
expect(2 "" run "${four}" -o "${WORK}/file" --no-plots)

# Without gnuplot: a warning with a hint, nothing else.
set(ENV{PATH} "${WORK}/empty")
expect(0 "apt-get install gnuplot-nox" run "${four}" -o "${WORK}/no_gnuplot")
expect(0 "apt-get install gnuplot-nox" plot "${WORK}/no_gnuplot")
