#!/usr/bin/env bash
# Sets up, builds the calibration and fits tensile strength and delta0 to a measured load-CMOD curve, from which a beam
# of another size is predicted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

out="out/calibration"
scripts/setup.sh
cmake --preset release
cmake --build --preset release --target fpz-calibrate
build/release/bin/fpz-calibrate data/calibration/gregoire_d50_modulus.json -o "$out" --force

pictures="$(find "$out" -name '*.png' | sort)"
if [ -z "$pictures" ]; then
  echo "run_calibration.sh: fpz-calibrate left no pictures in $out" >&2
  exit 1
fi
echo "Report: $PWD/$out/report.md"
echo "Pictures:"
while read -r picture; do echo "  $PWD/$picture"; done <<<"$pictures"
