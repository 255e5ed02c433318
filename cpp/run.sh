#!/bin/sh
# Installs missing packages, builds, and runs the main job: a beam on one-sided supports, solved by the 1989
# FORTRAN and by C++ side by side, increment by increment. Arguments, if any, go to contct, which runs where
# the caller is: file names are the caller's.
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
[ "$(pwd -P)" != "$here" ] || root="" # names as the README has them
[ $# -gt 0 ] || set -- run "${root}reference/problems/pb07-three-gap-supports.toml"
echo "${root}build/release/contct $*"
echo
exec "$here/build/release/contct" "$@"
