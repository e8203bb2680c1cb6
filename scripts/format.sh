#!/usr/bin/env bash
# Formats all C++ sources with clang-format 14, whose result later versions do not always share.
# With --check: changes nothing, names the files that are not formatted, and fails if there are any.
# Without clang-format 14 nothing is done, which is a failure where CI=true.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tool="$(command -v clang-format-14 || command -v clang-format || true)"
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
  echo "format.sh: clang-format 14 not found (scripts/setup.sh --ci installs it); nothing done" >&2
  [ "${CI:-}" != true ]
  exit
fi

mapfile -t files < <(git ls-files -- '*.hpp' '*.h' '*.cpp' '*.inl')
if [ "${1:-}" = --check ]; then
  status=0
  for file in "${files[@]}"; do
    if ! "$tool" "$file" | cmp -s "$file" -; then
      echo "not formatted: $file"
      status=1
    fi
  done
  exit "$status"
fi
"$tool" -i "${files[@]}"
