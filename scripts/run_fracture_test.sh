#!/usr/bin/env bash
# Sets up, builds the particle method and runs one of the ready fracture tests; says where its pictures are. Further
# arguments go to fpz-sph.
#   scripts/run_fracture_test.sh [beam_3pb | scb | ring] [--set path=value ...]     (default: beam_3pb)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scene="beam_3pb"
if [ $# -gt 0 ] && [[ "$1" != -* ]]; then
  scene="$1"
  shift
fi
if [ ! -f "data/scenes/$scene.json" ]; then
  echo "run_fracture_test.sh: there is no data/scenes/$scene.json; take one of: $(cd data/scenes && echo *.json)" >&2
  exit 2
fi

out="out/$scene"
scripts/setup.sh
cmake --preset release
cmake --build --preset release --target fpz-sph
build/release/bin/fpz-sph "data/scenes/$scene.json" -o "$out" --force "$@"

pictures="$(find "$out" -name '*.png' | sort)"
if [ -z "$pictures" ]; then
  echo "run_fracture_test.sh: fpz-sph left no pictures in $out" >&2
  exit 1
fi
echo "Frames for ParaView: $PWD/$out/frames.pvd"
echo "Pictures:"
while read -r picture; do echo "  $PWD/$picture"; done <<<"$pictures"
