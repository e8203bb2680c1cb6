#!/usr/bin/env bash
# Runs the ready paths, scenes and calibrations with the programs of two builds and compares what they write, byte for
# byte: shows that a change of the code changes no result. The data are those of this checkout. Not compared: pictures,
# wall times and what follows from them. One line per case; fails if anything differs.
#   scripts/compare_outputs.sh [--quick] OLD_BIN_FOLDER NEW_BIN_FOLDER [WORK]
# WORK (default build/compare) keeps the outputs in old/ and new/, and of every case that differs a file CASE.diff.
# --quick leaves out the cases that take more than about ten seconds.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

quick=no
if [ "${1:-}" = --quick ]; then
  quick=yes
  shift
fi
if [ $# -lt 2 ] || [ $# -gt 3 ]; then
  echo "usage: compare_outputs.sh [--quick] OLD_BIN_FOLDER NEW_BIN_FOLDER [WORK]" >&2
  exit 2
fi
old_bin="$(cd "$1" && pwd)"
new_bin="$(cd "$2" && pwd)"
work="${3:-$root/build/compare}"
rm -rf "$work/old" "$work/new"
mkdir -p "$work/old" "$work/new"
work="$(cd "$work" && pwd)"
rm -f "$work"/*.diff
# Both versions run as bin/PROGRAM in a folder of their own, so that messages do not differ in a path.
ln -s "$old_bin" "$work/old/bin"
ln -s "$new_bin" "$work/new/bin"
data="$work/data"
rm -f "$data"
ln -s "$root/data" "$data"
data=../data

same=0
different=0
missing=0

# Without wall times, and numbers made of them, in the JSON files and the messages of the programs.
without_times() {
  sed -E -e 's/"(wall_seconds|stepping_seconds|particle_steps_per_second)": [-+.0-9e]+/"\1": -/' \
    -e 's/, [-+.0-9e]+ s$/, - s/' -e '/ elapsed/d' "$1"
}

# one_side <old|new> <case> <program> <arguments>...: output in OUT (replaced by the case's folder), what the program
# says and its exit status beside it.
one_side() {
  local side="$1" name="$2" program="$3"
  shift 3
  (
    cd "$work/$side"
    mkdir -p "$name"
    status=0
    "bin/$program" "${@//OUT/$name/out}" >>"$name/stdout" 2>>"$name/stderr" || status=$?
    echo "$status" >>"$name/status"
  )
}

# run <case> <program> <arguments>...: runs both versions; several calls with the same case add up.
run() {
  local name="$1" program="$2"
  if [ ! -x "$old_bin/$program" ] || [ ! -x "$new_bin/$program" ]; then return; fi
  one_side old "$@"
  one_side new "$@"
}

# judge <case>: compares what the runs of the case left.
judge() {
  local name="$1" file old new ok=yes
  if [ ! -d "$work/old/$name" ]; then
    echo "not built       $name"
    missing=$((missing + 1))
    return
  fi
  while read -r file; do
    old="$work/old/$name/$file"
    new="$work/new/$name/$file"
    if [ ! -f "$old" ] || [ ! -f "$new" ]; then
      echo "only one version wrote $file" >>"$work/$(basename "$name").diff"
      ok=no
    elif ! cmp -s "$old" "$new" && ! cmp -s <(without_times "$old") <(without_times "$new"); then
      diff -u --label "old/$name/$file" --label "new/$name/$file" <(without_times "$old") <(without_times "$new") |
        head -n 40 >>"$work/$(basename "$name").diff" || true
      ok=no
    fi
  done < <({ cd "$work/old/$name" && find . -type f; cd "$work/new/$name" && find . -type f; } |
    grep -vE '\.(png|svg|pdf|gp)$' | sort -u)
  if [ "$ok" = yes ]; then
    same=$((same + 1))
    echo "same            $name"
  else
    different=$((different + 1))
    echo "DIFFERENT       $name"
  fi
}

# one <case> <program> <arguments>...: a case of a single run.
one() {
  run "$@"
  judge "$1"
}

# What the programs say of themselves.
for command in "" run plot check compare replay; do
  # shellcheck disable=SC2086
  run driver_help fpz-driver $command --help
done
judge driver_help
one calibrate_help fpz-calibrate --help
for command in "" check sweep plot; do
  # shellcheck disable=SC2086
  run sph_help fpz-sph $command --help
done
judge sph_help

# Element tests; the tangents along them; comparison with a reference.
for path in "$root"/data/paths/*.json; do
  name="$(basename "$path" .json)"
  one "path_$name" fpz-driver run "$data/paths/$name.json" -o OUT --no-plots
  one "tangents_$name" fpz-driver check "$data/paths/$name.json" --every 20
done
run compare_four_stage fpz-driver run "$data/paths/four_stage.json" -o OUT --no-plots
run compare_four_stage fpz-driver compare OUT/history.csv "$data/reference/four_stage.csv" --stress-tolerance 1e-7
run compare_four_stage fpz-driver compare OUT/history.csv "$data/reference/four_stage.csv" --stress-tolerance 1e-12
judge compare_four_stage

# Faulty input: what is said about it.
for seed in "$root"/tests/fuzz/corpus/*; do
  run faulty_paths fpz-driver run "$seed" -o OUT --no-plots --force
done
judge faulty_paths

# Calibrations.
for specification in "$root"/data/calibration/*.json; do
  name="$(basename "$specification" .json)"
  if [ "$quick" = yes ] && [[ "$name" == *_both ]]; then continue; fi
  one "calibration_$name" fpz-calibrate "$data/calibration/$name.json" -o OUT --no-plots
done

# Fracture tests. First variants on a coarse grid that go through every choice of the method.
beam() {
  local name="$1"
  shift
  one "$name" fpz-sph "$data/scenes/beam_3pb.json" -o OUT --no-pictures --set spacing=0.008 "$@"
}
beam beam_coarse
beam beam_baseline --set method.instruction_set=baseline --set method.integrator=accurate
beam beam_paper --set method.integrator=paper --set method.momentum=paper --set method.rve_length=spacing \
  --set method.zero_energy_control=0 --set material=../materials/bellego.json --set stop.time=0.005
beam beam_updated --set method.configuration=updated --set method.artificial_stress=0.3 \
  --set method.viscosity_alpha=0.5 --set method.viscosity_beta=0.2 --set method.skin=0.4
beam beam_updated_paper --set method.configuration=updated --set method.momentum=paper \
  --set method.kernel=wendland_c2 --set method.smoothing_ratio=1.5
beam beam_damped --set method.damping=0.02 --set method.mass_scale=4 --set method.gravity=[0,-9.81] \
  --set method.release_integrity=0.01 --set method.courant=0.4 --set method.rve_length=0.008
# Interrupted and resumed.
run beam_resumed fpz-sph "$data/scenes/beam_3pb.json" -o OUT --no-pictures --set spacing=0.008 --steps 7000
run beam_resumed fpz-sph "$data/scenes/beam_3pb.json" -o OUT --no-pictures --set spacing=0.008 --resume
judge beam_resumed
one beam_faulty fpz-sph "$data/scenes/beam_3pb.json" -o OUT --no-pictures --set method.kernel=cubic \
  --set method.courant=9 --set method.bogus=1 --set gauges.load.force_on=nothing
for scene in "$root"/data/scenes/*.json; do
  name="$(basename "$scene" .json)"
  if [ "$quick" = yes ] && [ "$name" != beam_3pb ]; then
    one "scene_${name}_start" fpz-sph "$data/scenes/$name.json" -o OUT --no-pictures --set stop.time=0.001
    continue
  fi
  one "scene_$name" fpz-sph "$data/scenes/$name.json" -o OUT --no-pictures
done

echo "$same cases the same, $different different, $missing not built in both"
[ "$different" -eq 0 ] && [ "$same" -gt 0 ]
