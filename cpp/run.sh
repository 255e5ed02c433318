#!/bin/sh
# Installs missing packages, builds, and runs contct in the caller's folder with the given arguments. Without arguments,
# solves a beam on one-sided supports by the 1989 FORTRAN and by C++ in lockstep.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
. "$here/cpp/install.sh"
need_core
need_program
echo "building in build/release"
(cd "$here" && silently cmake --preset release -DCONTCT_BUILD_TESTS=OFF && silently cmake --build --preset release)
root="$here/"
[ "$(pwd -P)" != "$here" ] || root="" # prints relative names, as in the README
[ $# -gt 0 ] || set -- run "${root}reference/problems/pb07-three-gap-supports.toml"
echo "${root}build/release/contct $*"
echo
exec "$here/build/release/contct" "$@"
