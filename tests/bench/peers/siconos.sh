#!/bin/sh
# Unpacks Debian's Siconos into BUILD/siconos, where CMake finds it. It is not installed: with it comes OpenBLAS, which
# would become this system's LAPACK. usage: sh tests/bench/peers/siconos.sh BUILD
# Exit 0: it is there; 77: skipped, since it cannot be had.
set -eu
[ $# -eq 1 ] || { echo "usage: sh tests/bench/peers/siconos.sh BUILD" >&2; exit 2; }
mkdir -p "$1/siconos"
cd "$1/siconos"
library=usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
[ ! -e "$library/libopenblas.so.0" ] || exit 0

skip() {
  echo "Siconos: SKIPPED: $1"
  exit 77
}
command -v apt-get >/dev/null 2>&1 && command -v dpkg-deb >/dev/null 2>&1 || skip "not a Debian system"
set -- libsiconos-numerics-dev libsiconos-numerics7 libmumps-seq-5.5 libscotch-7.0 libcxsparse3 libldl2 liblapacke libtmglib3 \
  libopenblas0-pthread
# As root, apt-get fetches as a user of its own, who may not write here: hence the warning, which is left out.
apt-get download "$@" >log 2>&1 || skip "its packages cannot be fetched: $(tail -n 1 log)"
for package in *.deb; do
  dpkg-deb -x "$package" . || skip "$package cannot be unpacked"
  rm "$package"
done
# By itself: beside it is a libblas.so.3, which only Siconos is to have.
ln -s openblas-pthread/libopenblas.so.0 "$library/libopenblas.so.0"
