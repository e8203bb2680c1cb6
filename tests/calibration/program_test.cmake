# Runs fpz-calibrate from outside: exit statuses, files, and that the driver takes the material.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../support/program.cmake")

function(expect_file there)
  foreach(file ${ARGN})
    if(there AND NOT EXISTS "${WORK}/${file}")
      message(SEND_ERROR "${file} is missing")
    elseif(NOT there AND EXISTS "${WORK}/${file}")
      message(SEND_ERROR "${file} should not be there")
    endif()
  endforeach()
endfunction()

set(spec "${DATA}/calibration/strength.json")

expect(0 "Examples:" --help)
expect(2 "")
expect(2 "" "${spec}")
expect(2 "missing.json" "${WORK}/missing.json" -o "${WORK}/x")
expect(0 "strengths: strength, 7 points, fitted" "${spec}" --check)
expect_file(FALSE x)

expect(0 "friction_angle_deg" "${spec}" -o "${WORK}/strength" --no-plots --starts 2)
expect_file(TRUE strength/material.json strength/report.json strength/report.md strength/report.html strength/curve_strengths.csv)
expect_file(FALSE strength/material_unusable.json strength/residuals.png)
expect(2 "--force" "${spec}" -o "${WORK}/strength" --no-plots)
expect(0 "" "${spec}" -o "${WORK}/strength" --no-plots --force --starts 2)
file(GLOB left_over "${WORK}/strength/.*")
if(left_over)
  message(SEND_ERROR "temporary files are left: ${left_over}")
endif()

# The driver reads the material unchanged.
file(WRITE "${WORK}/path.json" "{\"material\": \"strength/material.json\", \"rve_length\": 0.002,
  \"setting\": \"plane_strain\", \"integrator\": {\"name\": \"accurate\", \"tolerance\": 1e-6},
  \"stages\": [{\"increments\": 10, \"strain\": {\"xx\": 1e-3}}]}")
if(DRIVER)
  execute_process(COMMAND "${DRIVER}" run "${WORK}/path.json" -o "${WORK}/driver" --no-plots
    RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "the driver refuses the calibrated material: ${out}${err}")
  endif()
endif()

# Energies of one test determine one parameter, not two: files are written, but nobody can take them for a result.
file(COPY "${DATA}/materials/johnstone.json" DESTINATION "${WORK}")
file(WRITE "${WORK}/open.json" "{\"material\": \"johnstone.json\", \"fit\": [\"delta0\", \"tensile_strength\"],
  \"data\": [{\"name\": \"G1\", \"kind\": \"fracture_energy\", \"mode\": \"I\", \"energy\": 10.8, \"deviation\": 0.5},
           {\"name\": \"G2\", \"kind\": \"fracture_energy\", \"mode\": \"I\", \"energy\": 11.1, \"deviation\": 0.5}]}")
expect(1 "not usable (undetermined)" "${WORK}/open.json" -o "${WORK}/open" --no-plots)
expect_file(TRUE open/material_unusable.json open/report.md)
expect_file(FALSE open/material.json)

# A slip of units is named with its place.
file(WRITE "${WORK}/slip.json" "{\"material\": \"johnstone.json\", \"fit\": [\"delta0\"],
\"parameters\": {\"tensile_strength\": 3.9},
\"data\": [{\"name\": \"G\", \"kind\": \"fracture_energy\", \"mode\": \"I\", \"energy\": 10.8, \"deviation\": 0.5}]}")
expect(2 "slip.json:2: parameters.tensile_strength" "${WORK}/slip.json" -o "${WORK}/slip")
expect(2 "3.9 MPa was probably meant" "${WORK}/slip.json" --check)
expect_file(FALSE slip)

# One command from a curve and its lengths, and the specification that it used.
set(beam beam --depth 50mm --span 125mm --notch 25mm --thickness 50mm
    "${DATA}/lab/Gregoire2013_D50_halfnotch_envelope.csv" --cmod 1 --cmod-unit mm --load 3 --load-unit N)
expect(0 "notched_beam" ${beam} --check)
expect(2 "say the unit" beam --depth 50 --span 125mm --notch 25mm --thickness 50mm x.csv -o "${WORK}/x")
expect(2 "" beam --depth 50mm -o "${WORK}/x")
expect_file(FALSE x)

# A file where the folder should be.
file(WRITE "${WORK}/file" "")
expect(2 "" "${spec}" -o "${WORK}/file" --no-plots)

# Without gnuplot: a warning with a hint, nothing else.
set(ENV{PATH} "${WORK}/empty")
expect(0 "apt-get install gnuplot-nox" "${spec}" -o "${WORK}/no_gnuplot" --starts 1)
