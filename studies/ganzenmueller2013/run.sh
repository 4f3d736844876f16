#!/usr/bin/env bash
# run.sh BUILD OUT: the whole study, the finer meshes it needs and its pictures,
# OUT/ganzenmueller2013.png and OUT/crack_opening.png.
set -euo pipefail
if [[ $# -ne 2 ]]; then
  echo "usage: $0 BUILD OUT" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=$("$here/../../scripts/find_python.sh")
mkdir -p "$2"
"$python" "$here/mesh.py" "$2"
"$1/studies/ganzenmueller2013/ganzenmueller2013" "$here/expected.csv" "$here/bar.msh" "$2/bar_1.msh" "$2/bar_2.msh" --out "$2"
"$python" "$here/plot.py" "$2"
"$1/studies/ganzenmueller2013/ganzenmueller2013_opening" "$here/expected_opening.csv" --out "$2"
"$python" "$here/plot_opening.py" "$2"
