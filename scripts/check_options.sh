#!/usr/bin/env bash
# Every combination of the build's options configures, gives exactly the programs it should, builds and passes its tests.
#   scripts/check_options.sh [--configure-only] [NAME...]
# --configure-only  only the first two; a minute
# NAME...           only these combinations, named by the options that are on: DRIVER+SPH, ..., or NONE
# The build folders are build/options/NAME and stay; ccache makes the builds quick.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

configure_only=no
if [ "${1:-}" = --configure-only ]; then
  configure_only=yes
  shift
fi
options=(DRIVER CALIBRATION SPH INTERFACES BENCH TESTS)
wanted=("$@")

# expected_programs <name of the combination>: sorted, one a line.
expected_programs() {
  has() { [[ "+$1+" == *"+$2+"* ]]; }
  {
    if has "$1" DRIVER; then echo fpz-driver; fi
    if has "$1" CALIBRATION; then printf '%s\n' fpz-calibrate fpz-notched-reference; fi
    if has "$1" SPH; then printf '%s\n' fpz-patch-report fpz-sph fpz-sph-report; fi
    if has "$1" INTERFACES; then echo fpz-fe-beam; fi
    if has "$1" BENCH; then printf '%s\n' fpz-bench fpz-speed-report; fi
    if has "$1" BENCH && has "$1" SPH; then printf '%s\n' fpz-sph-bench fpz-sph-performance; fi
    if has "$1" BENCH && has "$1" INTERFACES; then echo fpz-interface-bench; fi
    if has "$1" BENCH && has "$1" CALIBRATION; then echo fpz-beam-bench; fi
    if has "$1" TESTS && has "$1" CALIBRATION; then echo fpz-verdict-study; fi
    if has "$1" TESTS && [ "$1" != TESTS ]; then echo fpz-doc-tables; fi
  } | sort
}

# check_combination <name>: says what is wrong, if anything.
check_combination() {
  local name="$1" folder="build/options/$1" switches=() option
  for option in "${options[@]}"; do
    if [[ "+$name+" == *"+$option+"* ]]; then
      switches+=("-DFPZ_BUILD_$option=ON")
    else
      switches+=("-DFPZ_BUILD_$option=OFF")
    fi
  done
  rm -rf "$folder"
  mkdir -p "$folder"
  if ! cmake -S . -B "$folder" -G Ninja -DFPZ_WERROR=ON "${switches[@]}" >"$folder/log" 2>&1; then
    cat "$folder/log"
    return 1
  fi
  if ! diff <(expected_programs "$name") <(sed -n 's/^build bin\/\(fpz-[^:]*\):.*/\1/p' "$folder/build.ninja" | sort); then
    echo "the programs differ (<: expected, >: found)"
    return 1
  fi
  if [ "$configure_only" = yes ]; then return 0; fi
  if ! cmake --build "$folder" >"$folder/log" 2>&1; then
    tail -n 50 "$folder/log"
    return 1
  fi
  if [[ "$name" != *TESTS* ]]; then return 0; fi
  if ! ctest --test-dir "$folder" --output-on-failure --no-tests=error --parallel "$(nproc)" >"$folder/log" 2>&1; then
    tail -n 50 "$folder/log"
    return 1
  fi
}

failed=0
count=0
for ((bits = 0; bits < 1 << ${#options[@]}; ++bits)); do
  name=""
  for ((k = 0; k < ${#options[@]}; ++k)); do
    if ((bits >> k & 1)); then name+="${name:++}${options[k]}"; fi
  done
  name="${name:-NONE}"
  if [ "${#wanted[@]}" -gt 0 ] && [[ " ${wanted[*]} " != *" $name "* ]]; then continue; fi
  count=$((count + 1))
  if message="$(check_combination "$name")"; then
    echo "ok      $name"
  else
    failed=$((failed + 1))
    echo "FAILED  $name"
    echo "$message"
  fi
done
echo "$((count - failed)) of $count combinations are right"
[ "$failed" -eq 0 ] && [ "$count" -gt 0 ]
