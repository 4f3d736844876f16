#!/usr/bin/env bash
# Format, include directions and clang-tidy over every source. Says what is wrong and exits with 1.
#   scripts/lint.sh [--quick]      --quick leaves clang-tidy out
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/install_deps.sh --dev

mapfile -t sources < <(find include src tests studies -name '*.cpp' -o -name '*.hpp' | sort)
failed=()

clang-format-16 --dry-run -Werror "${sources[@]}" || failed+=(format)
python3 scripts/check_includes.py || failed+=(includes)

if [ "${1:-}" != --quick ]; then
  cmake --preset tidy >/dev/null
  # clang lacks omp.h. It gets GCC's, alone, and without the attribute arguments that only GCC knows.
  mkdir -p build/tidy/openmp
  ln -sf "$(g++ -print-file-name=include/omp.h)" build/tidy/openmp/omp.h
  # Library, program and studies, several sources at a time (most of the work is in the headers they share), but for what is
  # built with SLEPc only.
  python3 -c 'import json; print(*(entry["file"] for entry in json.load(open("build/tidy/compile_commands.json"))), sep="\n")' |
    xargs -P "$(nproc)" -n 1 clang-tidy-16 --quiet -p build/tidy --checks=-bugprone-suspicious-include \
      --extra-arg=-isystem"$PWD/build/tidy/openmp" --extra-arg='-D__malloc__(...)=__malloc__' 2>/dev/null || failed+=(clang-tidy)
fi

if [ ${#failed[@]} -gt 0 ]; then
  echo "lint: failed: ${failed[*]}"
  exit 1
fi
echo "lint: ${#sources[@]} files are clean"
