#!/usr/bin/env bash
# clang-tidy 14 over the sources; any finding fails. Which checks are on, and why others are not, is in .clang-tidy.
#   scripts/tidy.sh [--changed BASE] [--minutes N] [FILE.cpp...]
# Without files: every source, those touched by the latest commits first. A header counts as the first source that
# includes it.
# --changed BASE  only what differs from the merge base with BASE
# --minutes N     what has not been begun by then is left out, and its number is said
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

base=""
minutes=1000
while [ $# -gt 0 ]; do
  case "$1" in
    --changed) base="$2"; shift 2 ;;
    --minutes) minutes="$2"; shift 2 ;;
    -*) echo "tidy.sh: unknown option $1" >&2; exit 2 ;;
    *) break ;;
  esac
done

tool="$(command -v clang-tidy-14 || command -v clang-tidy || true)"
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
  echo "tidy.sh: clang-tidy 14 not found; scripts/setup.sh --ci installs it" >&2
  exit 1
fi
database=build/release
[ -f "$database/compile_commands.json" ] || cmake --preset release >/dev/null
compiled="$(sed -n "s|.*\"file\": \"$PWD/\(.*\)\".*|\1|p" "$database/compile_commands.json" | sort -u)"

# Source files and headers, those changed last first.
candidates() {
  if [ -n "$base" ]; then
    git diff --name-only "$(git merge-base "$base" HEAD)"
  else
    git diff --name-only HEAD
    git log --format= --name-only
    echo "$compiled"
  fi | awk 'NF && !seen[$0]++'
}

# The source to check for a file: itself, or the first one that includes the header.
source_of() {
  case "$1" in
    *.cpp) if grep -qxF "$1" <<<"$compiled"; then echo "$1"; fi ;;
    *.hpp | *.h | *.inl)
      if [ -f "$1" ]; then
        local name="${1##*/include/}"
        if [ "$name" = "$1" ]; then name="${1##*/}"; fi
        { grep -lF "\"$name\"" $compiled || true; } | head -n 1
      fi ;;
  esac
}

if [ $# -gt 0 ]; then
  files=("$@")
else
  mapfile -t files < <(candidates | while read -r file; do source_of "$file"; done | awk '!seen[$0]++')
fi
if [ "${#files[@]}" -eq 0 ]; then
  echo "tidy.sh: no source to check"
  exit 0
fi

left_out="$(mktemp)"
trap 'rm -f "$left_out"' EXIT
deadline=$(($(date +%s) + 60 * minutes))
# Prints and fails only if there is something to say.
one() {
  if [ "$(date +%s)" -ge "$deadline" ]; then
    echo "$1" >>"$left_out"
    return 0
  fi
  local text status=0
  text="$("$tool" --quiet -p "$database" "$1" 2>&1)" || status=$?
  if [ "$status" -ne 0 ]; then
    printf '%s\n' "$text" | grep -v 'warnings generated\|warnings treated as errors'
    return 1
  fi
}
export -f one
export tool database deadline left_out
status=0
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'one "$1"' one || status=1

skipped="$(wc -l <"$left_out")"
echo "tidy.sh: $((${#files[@]} - skipped)) of ${#files[@]} sources checked$([ "$skipped" -eq 0 ] || echo "; the time was over")"
exit "$status"
