#!/usr/bin/env bash
# run.sh BUILD OUT: the whole study (some 10 s of one core) and its picture, OUT/bouaraquia2024.png.
set -euo pipefail
if [[ $# -ne 2 ]]; then
  echo "usage: $0 BUILD OUT" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
"$1/studies/bouaraquia2024/bouaraquia2024" "$here/expected.csv" "$2"
python=$("$here/../../scripts/find_python.sh")
"$python" "$here/plot.py" "$2"
