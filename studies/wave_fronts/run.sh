#!/usr/bin/env bash
# run.sh BUILD OUT: the study and its pictures, OUT/kernels.png, OUT/fronts_2.png and OUT/fronts_3.png.
set -euo pipefail
if [[ $# -ne 2 ]]; then
  echo "usage: $0 BUILD OUT" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=$("$here/../../scripts/find_python.sh")
"$1/studies/wave_fronts/wave_fronts" --out "$2"
"$python" "$here/plot.py" "$2"
