#!/usr/bin/env bash
# Installs what is missing, builds Release and runs every test not labelled slow.
#   scripts/test.sh [ctest arguments, for example -R unit_linalg]
# PERIMODE_CMAKE_ARGS: more arguments for the configuration.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_deps.sh
read -ra cmake_arguments <<<"${PERIMODE_CMAKE_ARGS:-}"
cmake --preset release "${cmake_arguments[@]}"
cmake --build --preset release --parallel "$(nproc)"
ctest --preset release "$@"
