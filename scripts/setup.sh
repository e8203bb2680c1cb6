#!/usr/bin/env bash
# Installs what the project builds and runs with (Debian 12 or later, or a relative of it); with --ci also the tools of
# its checks (.ci/run). Does nothing, and needs no network, when all packages are present.
set -euo pipefail

packages=(
  build-essential cmake ninja-build
  libeigen3-dev libceres-dev nlohmann-json3-dev libcli11-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  gnuplot-nox libgnuplot-iostream-dev
  libboost-iostreams-dev libboost-filesystem-dev libboost-system-dev zlib1g-dev
  gfortran pybind11-dev python3-dev python3-numpy valgrind pkg-config
)
case "${1:-}" in
  "") ;;
  --ci) packages+=(clang-format-14 clang-tidy-14 ccache git) ;;
  *) echo "usage: setup.sh [--ci]" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup.sh knows only apt. Install by hand the equivalents of: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  if ! dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed; then
    missing+=("$package")
  fi
done
if [ "${#missing[@]}" -eq 0 ]; then
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: not root and no sudo; please install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

# Quiet unless something goes wrong.
log="$(mktemp)"
trap 'rm -f "$log"' EXIT
quietly() {
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "$@" >"$log" 2>&1; then
    cat "$log" >&2
    echo "setup.sh: failed: $*" >&2
    exit 1
  fi
}

echo "setup.sh: installing ${missing[*]}"
quietly apt-get update
quietly apt-get install -y --no-install-recommends "${missing[@]}"
