#!/bin/sh
# Tests that CalculiX (ccx) finds the same states as contct on solids whose matrix CalculiX wrote, on combinations of a
# base plate, and on problems of reference/benchmarks; and that Siconos does on all problems of reference/benchmarks.
# usage: sh tests/peer/run.sh [BUILD]      (default: build/release)
# Exit 0: all agree; 1: a difference; 77: skipped, a program is missing.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$(cd "${1:-build/release}" && pwd) || exit 1
. cpp/install.sh

skip() { echo "CalculiX and Siconos as peers: SKIPPED: $1 cannot be had"; exit 77; }
need "as a peer" calculix-ccx python3-numpy || true
command -v ccx >/dev/null 2>&1 || skip CalculiX

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Siconos is unpacked here, because installing it would make OpenBLAS the LAPACK of this system.
mkdir -p "$work/siconos/debs"
packages="python3-siconos libsiconos-numerics7 liblapacke libtmglib3 libboost-serialization1.74.0 libopenblas0-pthread"
(
  cd "$work/siconos/debs" &&
    { apt-get download -qq $packages || { apt-get update -qq && apt-get download -qq $packages; }; } &&
    for package in *.deb; do dpkg -x "$package" .. || exit 1; done
) >"$work/log" 2>&1 || skip Siconos
# CalculiX's last digits depend on the number of threads.
export OMP_NUM_THREADS=1
python3 tests/bench/solid.py 1 "$work" && "$build/contct" run "$work/solid-1.toml" --quiet --strict || exit 1
python3 tests/peer/peer.py "$build/contct" "$(command -v ccx)" "$PWD/reference" "$work"
