#!/usr/bin/env bash
# Feeds the readers of case files, of particle tables and of meshes with mutated input (libFuzzer with sanitizers). Works on a copy
# of the corpus. Exits with 1 at the first finding and says where its input lies.
#   scripts/fuzz.sh [seconds]      seconds for each reader, 30 by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-30}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "usage: $0 [seconds]" >&2; exit 2; }
scripts/install_deps.sh --fuzz

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
run=build/fuzz/run
rm -rf "$run" && mkdir -p "$run"/{case,cloud,mesh,findings}
for file in tests/fuzz/corpus/case/* studies/*/*.yaml tests/bench/*.yaml; do cp "$file" "$run/case/${file//\//_}"; done
cp tests/fuzz/corpus/cloud/* "$run/cloud"
cp tests/fuzz/corpus/mesh/* "$run/mesh"

for reader in case cloud mesh; do
  echo "fuzz_$reader: $seconds s"
  # An input of a few kilobytes that takes seconds, or half a gigabyte, is a finding too.
  build/fuzz/tests/fuzz/fuzz_$reader -max_total_time="$seconds" -timeout=5 -rss_limit_mb=512 -max_len=8192 \
    -dict=tests/fuzz/$reader.dict -artifact_prefix="$run/findings/$reader-" "$run/$reader" 2>"$run/$reader.log" || {
    tail -40 "$run/$reader.log"
    echo "fuzz_$reader: a finding; run build/fuzz/tests/fuzz/fuzz_$reader on what lies in $run/findings"
    exit 1
  }
  grep -E '^Done|stat::|^#.*DONE' "$run/$reader.log" | tail -1
done
echo "fuzz: no findings"
