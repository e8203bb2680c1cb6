# Runs fpz-sph from outside: exit statuses, files, interruption, what happens without gnuplot or with files in the way.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../../support/program.cmake")

set(beam "${DATA}/scenes/beam_3pb.json")
set(quick --set spacing=0.008 --set stop.time=3e-4 --set output.history_rows=50 --set output.frames=3)

expect(0 "Examples:" --help)
expect(0 "Example:" check --help)
expect(0 "Example:" plot --help)
expect(2 "")
expect(2 "--out" "${beam}")
expect(2 "missing.json" "${WORK}/missing.json" -o "${WORK}/x")
expect(2 "did you mean" "${beam}" -o "${WORK}/x" --set methud.courant=0.3)

expect(0 "the scene is valid" check "${beam}" --set spacing=0.008 -o "${WORK}/check")
expect(0 "stop.time" "${beam}" -o "${WORK}/beam" ${quick})
expect(2 "--force" "${beam}" -o "${WORK}/beam" ${quick})
expect(0 "" "${beam}" -o "${WORK}/beam" ${quick} --force --no-pictures)
expect(0 "pictures" plot "${WORK}/beam")
expect(2 "no checkpoint" "${beam}" -o "${WORK}/nothing" ${quick} --resume)
expect(2 "has come to its end" "${beam}" -o "${WORK}/beam" ${quick} --resume)
foreach(file scene.json history.csv summary.json crack.csv frames.pvd frames/frame_00000.vtu load_deflection.png damage.png
        velocity.png energies.svg ../check/scene.png)
  if(NOT EXISTS "${WORK}/beam/${file}")
    message(SEND_ERROR "${file} is missing")
  endif()
endforeach()

# The scene in the folder makes the same run.
expect(0 "" "${WORK}/beam/scene.json" -o "${WORK}/again" --no-pictures)
file(READ "${WORK}/beam/history.csv" first)
file(READ "${WORK}/again/history.csv" second)
if(NOT first STREQUAL second)
  message(SEND_ERROR "scene.json in the output folder gives another history")
endif()

# A time step that something makes far too short is warned about.
expect(0 "times shorter than \"courant\" asks for" check "${beam}" --set spacing=0.004 --set method.smoothing_ratio=0.9
       --set notches[0].width=0 -o "${WORK}/slow" --no-pictures)

# Interrupted by steps and resumed: the same history.
expect(3 "--resume" "${beam}" -o "${WORK}/parts" ${quick} --no-pictures --steps 100)
expect(0 "" "${beam}" -o "${WORK}/parts" ${quick} --no-pictures --resume --threads 2)
file(READ "${WORK}/parts/history.csv" second)
if(NOT first STREQUAL second)
  message(SEND_ERROR "a resumed run gives another history")
endif()

# Sends the signal to a run as soon as the file exists, however slow the machine.
function(interrupt signal file)
  execute_process(COMMAND sh -c "\"$@\" & run=$!
                                 until [ -e '${file}' ] || ! kill -0 $run 2>/dev/null; do sleep 0.1; done
                                 kill -${signal} $run; wait $run" sh ${ARGN}
                  OUTPUT_VARIABLE out ERROR_QUIET)
  set(out "${out}" PARENT_SCOPE)
endfunction()

# Killed in the middle: every file under its final name is whole, and the run goes on.
interrupt(KILL "${WORK}/killed/checkpoint.bin" "${PROGRAM}" "${beam}" -o "${WORK}/killed" --set spacing=0.004
          --set stop.time=10 --set output.checkpoint_seconds=0.2 --set output.frames=1000 --no-pictures)
expect(3 "" "${beam}" -o "${WORK}/killed" --set spacing=0.004 --set stop.time=10 --set output.checkpoint_seconds=0.2
       --set output.frames=1000 --no-pictures --resume --steps 10)
file(GLOB_RECURSE left_over "${WORK}/killed/.*")
if(left_over)
  message(SEND_ERROR "temporary files are left: ${left_over}")
endif()
# SIGTERM leaves a checkpoint.
interrupt(TERM "${WORK}/terminated/frames/frame_00000.vtu" "${PROGRAM}" "${beam}" -o "${WORK}/terminated"
          --set spacing=0.004 --set stop.time=10 --no-pictures)
string(FIND "${out}" "--resume" found)
if(found EQUAL -1 OR NOT EXISTS "${WORK}/terminated/checkpoint.bin")
  message(SEND_ERROR "SIGTERM: no checkpoint, or not said: ${out}")
endif()

# A sweep: twice, because the second time nothing is left to do; its pictures; a failed run shows in the exit status.
file(WRITE "${WORK}/sweep.json" "{\"scene\": \"${beam}\", \"parameter\": {\"name\": \"speed\", \"path\":
  \"boundaries[0].velocity.y.speed\", \"values\": [-0.05, -0.1]},
  \"set\": {\"output.pictures\": false}}")
expect(0 "2 of 2 runs finished (0 were" sweep "${WORK}/sweep.json" -o "${WORK}/sweep" ${quick})
expect(0 "2 of 2 runs finished (2 were" sweep "${WORK}/sweep.json" -o "${WORK}/sweep" ${quick} --no-pictures --jobs 1)
foreach(file sweep.csv peak_load.png load_deflection_runs.svg damage_runs.png runs/-0.05/summary.json)
  if(NOT EXISTS "${WORK}/sweep/${file}")
    message(SEND_ERROR "${file} of the sweep is missing")
  endif()
endforeach()
file(READ "${WORK}/sweep.json" sweep)
string(REPLACE "-0.1" "-4000" sweep "${sweep}")
string(REPLACE "\"output.pictures\"" "\"boundaries[0].velocity.y.ramp\": 1e-5, \"output.pictures\"" sweep "${sweep}")
file(WRITE "${WORK}/failing.json" "${sweep}")
expect(1 "FAILED" sweep "${WORK}/failing.json" -o "${WORK}/failing" ${quick} --no-pictures)
expect(2 "of other scenes" sweep "${WORK}/sweep.json" -o "${WORK}/sweep" ${quick} --set spacing=0.01)
expect(2 "varies that entry" sweep "${WORK}/sweep.json" -o "${WORK}/x" --set boundaries[0].velocity.y.speed=1)
expect(0 "Examples:" sweep --help)

# A file where the folder should be.
file(WRITE "${WORK}/file" "")
expect(2 "" "${beam}" -o "${WORK}/file" ${quick})

# Without gnuplot: a warning with a hint, nothing else.
set(ENV{PATH} "${WORK}/empty")
expect(0 "apt-get install gnuplot-nox" plot "${WORK}/beam")
