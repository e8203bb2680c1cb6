#!/usr/bin/env bash
# Sets up, builds the driver and runs the four-stage element test of section 4.5 of the paper.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

out="out/four_stage"
scripts/setup.sh
cmake --preset release
cmake --build --preset release --target fpz-driver
build/release/bin/fpz-driver run data/paths/four_stage.json -o "$out"

pictures="$(find "$out" -name '*.png' -o -name '*.svg' -o -name '*.pdf' | sort)"
if [ -z "$pictures" ]; then
  echo "run_four_stage.sh: the driver left no pictures in $out" >&2
  exit 1
fi
echo "Pictures:"
while read -r picture; do echo "  $PWD/$picture"; done <<<"$pictures"
