#!/usr/bin/env bash
# Writes the tables of the documentation again that are made of tables in the code (tests/docs).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --preset release
cmake --build --preset release --target doc_tables
