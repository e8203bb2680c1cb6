# The history of WRITER against the driver's, on the same path.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../support/program.cmake")

expect(0 "ok" run "${DATA}/paths/four_stage.json" -o "${WORK}/driver" --no-plots)
execute_process(COMMAND "${WRITER}" "${WORK}/interface.csv" COMMAND_ERROR_IS_FATAL ANY)
expect(0 "ok" compare "${WORK}/driver/history.csv" "${WORK}/interface.csv" --stress-tolerance 1e-12
  --damage-tolerance 1e-12 --strain-tolerance 1e-12)
# The comparison sees a difference where there is one.
expect(1 "DIFFERENT" compare "${WORK}/driver/history.csv" "${WORK}/interface.csv" --stress-tolerance 1e-20
  --damage-tolerance 1e-20 --strain-tolerance 1e-20)
