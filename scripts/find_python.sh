#!/usr/bin/env bash
# Prints a python3 that can draw: the first that imports numpy and matplotlib, Debian's own before others.
set -euo pipefail
for python in /usr/bin/python3 python3; do
  if "$python" -c 'import numpy, matplotlib' >/dev/null 2>&1; then
    command -v "$python"
    exit 0
  fi
done
echo "No python3 with numpy and matplotlib found; on Debian: apt-get install python3-numpy python3-matplotlib" >&2
exit 3
