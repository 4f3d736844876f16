#!/usr/bin/env bash
# run.sh BUILD OUT [--fine]: the study and its picture, OUT/hole_and_crack.png.
set -euo pipefail
if [[ $# -lt 2 ]]; then
  echo "usage: $0 BUILD OUT [--fine]" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=$("$here/../../scripts/find_python.sh")
"$1/studies/hole_and_crack/hole_and_crack" "${@:3}" --out "$2"
"$python" "$here/plot.py" "$2"
