#!/usr/bin/env bash
# run.sh BUILD OUT: the whole study (some 10 s of one core) and its pictures, OUT/bouaraquia2024.png and
# OUT/bouaraquia2024_dispersion.png.
set -euo pipefail
if [[ $# -ne 2 ]]; then
  echo "usage: $0 BUILD OUT" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
"$1/studies/bouaraquia2024/bouaraquia2024" "$here/expected.csv" "$2"
python=$("$here/../../scripts/find_python.sh")
"$python" "$here/plot.py" "$2"
"$1/studies/bouaraquia2024/bouaraquia2024_dispersion" "$here/expected_dispersion.csv" "$2"
"$python" "$here/plot_dispersion.py" "$2"
