#!/usr/bin/env bash
# run.sh BUILD OUT: modes of a bar, a plate and a cracked plate. Prints one table; writes it as OUT/modes_table.csv,
# a picture OUT/modes.png, and per case modes.csv, modes.exo (ParaView) and summary.json.
set -euo pipefail
if [[ $# -ne 2 ]]; then
  echo "usage: $0 BUILD OUT" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)

for name in bar plate plate_cracked; do
  "$build/src/cli/perimode" modal "$here/$name.yaml" --output "$out/$name" --force --quiet >/dev/null
done
"$build/studies/first_modes/first_modes" "$here" "$out/modes_table.csv"

python=$("$here/../../scripts/find_python.sh")
"$python" "$here/plot.py" "$out"
