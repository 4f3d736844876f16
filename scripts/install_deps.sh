#!/usr/bin/env bash
# Installs the Debian packages Perimode needs and that are missing; silent when none is.
#   scripts/install_deps.sh [--dev | --fuzz | --slepc]      adds what scripts/lint.sh, scripts/fuzz.sh or
#                                                     -DPERIMODE_WITH_SLEPC=ON need
# As root it installs; otherwise it prints the line to run and exits with 3.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libeigen3-dev libsuitesparse-dev libarpack2-dev libmumps-seq-dev
  libopenblas-pthread-dev liblapacke-dev coinor-libclp-dev
  libyaml-cpp-dev libcli11-dev libfmt-dev libspdlog-dev nlohmann-json3-dev
  libnanoflann-dev libexodusii-dev libhdf5-dev libfftw3-dev libmuparser-dev libxxhash-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  python3 python3-numpy python3-scipy python3-matplotlib python3-jsonschema python3-yaml
)
case "${1:-}" in
  "") ;;
  --dev) packages+=(clang-format-16 clang-tidy-16) ;;
  --fuzz) packages+=(clang-16 libclang-rt-16-dev llvm-16) ;;
  --slepc) packages+=(slepc-dev libopenmpi-dev pkg-config) ;;
  *) echo "usage: $0 [--dev | --fuzz | --slepc]" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "This is not Debian: install the counterparts of ${packages[*]}" >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null || true)
  grep -qx installed <<<"$status" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$(id -u)" -ne 0 ]; then
  echo "Missing packages. Run this, then start again:" >&2
  echo "  sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing[*]}" >&2
  exit 3
fi
echo "Installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
