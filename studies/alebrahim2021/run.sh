#!/usr/bin/env bash
# run.sh BUILD OUT: the whole study and its pictures, OUT/fig04.png ... OUT/fig11.png.
set -euo pipefail
if [[ $# -ne 2 ]]; then
  echo "usage: $0 BUILD OUT" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
status=0
"$1/studies/alebrahim2021/alebrahim2021" "$here/paper.csv" "$here/expected.csv" "$2" || status=$?
python=$("$here/../../scripts/find_python.sh")
"$python" "$here/plot.py" "$2"
exit "$status"
