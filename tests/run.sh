#!/bin/sh
# Installs what is missing, builds, and passes all tests. --full adds the legs that take longer: the
# sanitizers, gfortran's run-time checks, the build without the program, the whole campaign of random
# problems, the mutants of both kernels, a second LAPACK, CalculiX, other processors, the page in a browser, grids
# read back by VTK, formatting and clang-tidy.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
cd "$here"
. cpp/install.sh

full=no
for argument in "$@"; do
  case $argument in
    --full) full=yes ;;
    *) echo "usage: sh tests/run.sh [--full]" >&2; exit 2 ;;
  esac
done

need_core
need_program
need "to test" catch2 pkgconf python3 groff-base

# leg NAME: configure and build the preset of that name, quietly unless it fails, and test it.
leg() {
  echo "== $1: configuring, building, testing"
  log=$(mktemp)
  if ! { cmake --preset "$1" -DCONTCT_BUILD_TESTS=ON && cmake --build --preset "$1"; } >"$log" 2>&1; then
    cat "$log"
    rm -f "$log"
    echo "== $1: does not build" >&2
    exit 1
  fi
  rm -f "$log"
  ctest --preset "$1" -j "$(nproc 2>/dev/null || echo 2)" --progress
}

if [ "$full" = yes ]; then
  need "for the sources' form" clang-format clang-tidy
  need "for more compilers, as witnesses" flang-16 f2c libf2c2-dev clang
  need "for one more engine" libsuitesparse-dev
  need "for the manual and the shells that complete it" mandoc zsh fish
  echo "== clang-format"
  find cpp tests \( -name '*.[ch]pp' -o -name '*.[ch]' \) -exec clang-format --dry-run --Werror {} +
  leg core
  leg asan
  leg checked
  leg debug
fi
leg release
if [ "$full" = yes ]; then
  echo "== 200,000 random problems under the corrected rule"
  build/release/tests/contct_campaign 200000 2026
  echo "== mutants of both kernels"
  build/release/tests/contct_mutants
  echo "== two LAPACKs"
  sh tests/two_lapacks/run.sh build/release
  echo "== CalculiX as a peer"
  sh tests/peer/run.sh build/release || [ $? = 77 ]  # skipped, which is said
  echo "== other processors"
  sh tests/emulated/run.sh || [ $? = 77 ]  # none of their compilers can be had
  echo "== the page in a browser"
  sh tests/browser/run.sh build/release || [ $? = 77 ]  # chromium cannot be had
  echo "== grids read back by VTK"
  sh tests/vtk/run.sh build/release || [ $? = 77 ]  # VTK cannot be had
  sh tests/tree/tidy.sh build/release
  # The last lines are ctest's own summary, of everything that the release build has.
  ctest --preset release -j "$(nproc 2>/dev/null || echo 2)" --progress
fi
