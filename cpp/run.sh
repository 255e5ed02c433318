#!/bin/sh
# Installs missing packages, builds, and runs contct in the caller's folder with the given arguments. Without arguments,
# solves a beam on one-sided supports by the 1989 FORTRAN and by C++ in lockstep.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
. "$here/cpp/install.sh"
need_core
need_program
echo "building in build/release"
log=$(mktemp)
if ! (cd "$here" && cmake --preset release -DCONTCT_BUILD_TESTS=OFF && cmake --build --preset release) >"$log" 2>&1; then
  cat "$log"
  rm -f "$log"
  exit 1
fi
rm -f "$log"
root="$here/"
[ "$(pwd -P)" != "$here" ] || root="" # prints relative names, as in the README
[ $# -gt 0 ] || set -- run "${root}reference/problems/pb07-three-gap-supports.toml"
echo "${root}build/release/contct $*"
echo
exec "$here/build/release/contct" "$@"
