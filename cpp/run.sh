#!/bin/sh
# Installs what is missing, builds, and runs the main job: a beam on one-sided supports, solved by the
# 1989 FORTRAN and by C++ side by side, increment by increment. Arguments, if any, go to contct.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
cd "$here"
. cpp/install.sh
need_core
need_program
echo "building in build/release"
log=$(mktemp)
if ! { cmake --preset release -DCONTCT_BUILD_TESTS=OFF && cmake --build --preset release; } >"$log" 2>&1; then
  cat "$log"
  rm -f "$log"
  exit 1
fi
rm -f "$log"
[ $# -gt 0 ] || set -- run reference/problems/pb07-three-gap-supports.toml
echo "build/release/contct $*"
echo
exec build/release/contct "$@"
