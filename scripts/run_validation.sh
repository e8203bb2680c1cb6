#!/usr/bin/env bash
# Sets up, builds, runs the validation sweeps of the particle method (data/sweeps) and writes docs/validation.md with
# its pictures. Takes about 40 minutes on two free cores. Can be stopped (Ctrl-C) and started again: finished runs are
# kept, interrupted ones go on. The report says what has not been run; --report writes it from what there is.
#   scripts/run_validation.sh [--report] [OUTDIR]     (OUTDIR: build/validation)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

only_report=no
if [ "${1:-}" = "--report" ]; then
  only_report=yes
  shift
fi
out="${1:-build/validation}"

# The most important first.
sweeps=(
  method_dogbone method_compression method_disc method_beam
  solver_beam solver_scb
  beam_spacing beam_rollers beam_rate scb_angles ring_diameters
  beam_methods beam_fine scb_updated beam_methods_fine
)

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target fpz-sph fpz-sph-report
failed=()
if [ "$only_report" = no ]; then
  for sweep in "${sweeps[@]}"; do
    echo "== $sweep"
    status=0
    build/release/bin/fpz-sph sweep "data/sweeps/$sweep.json" -o "$out/$sweep" --no-pictures || status=$?
    if [ "$status" -eq 3 ]; then
      echo "run_validation.sh: interrupted; the same command goes on" >&2
      exit 3
    fi
    if [ "$status" -ne 0 ]; then failed+=("$sweep"); fi
  done
fi
build/release/bin/fpz-sph-report "$out" -o docs
if [ "${#failed[@]}" -gt 0 ]; then
  echo "run_validation.sh: not all runs of these sweeps finished: ${failed[*]} (the report says which)" >&2
fi
