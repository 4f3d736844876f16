#!/usr/bin/env bash
# From a fresh Debian to first results: installs what is missing, builds Release, computes the modes of a
# bar and of a plate with and without an edge crack. Results lie in out/demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD

scripts/install_deps.sh
cmake --preset release -DPERIMODE_BUILD_TESTS=OFF -B build/demo
cmake --build build/demo --parallel "$(nproc)"
mkdir -p out/demo
studies/first_modes/run.sh "$root/build/demo" "$root/out/demo"
echo
echo "Results lie in $root/out/demo:"
(cd out/demo && find . -type f | sort | sed 's|^\./|  |')
