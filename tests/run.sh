#!/bin/sh
# Installs missing packages, builds, and runs the tests: sh tests/run.sh [--full] [LEG]...
# Without arguments it runs the tests that check every promise once. .ci/run and --full run the long tests too: all commands of
# all pages, the course, mutants, languages, packages, and everything that needs another tool.
# LEG: a preset that is built and tested instead: core (without the program, with sanitizers and gfortran's run-time
# checks), asan (core with the program), tsan (threads). --full has all presets, and adds the campaigns at the end of this file.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
cd "$here"
. cpp/install.sh
started=$(date +%s)

full=no
legs=""
for argument in "$@"; do
  case $argument in
    --full) full=yes ;;
    core | asan | tsan) legs="$legs $argument" ;;
    *) echo "usage: sh tests/run.sh [--full] [core] [asan] [tsan]" >&2; exit 2 ;;
  esac
done
[ "$full" = no ] || legs="core asan tsan"

need_core
need_program
need "to test" catch2 python3 python3-jsonschema python3-capstone python3-z3

# build NAME [OPTION]: configures and builds this preset, and prints its messages only if it fails. Adds what CMake
# reports as skipped to the file $skipped.
skipped=$(mktemp)
build() {
  echo "== $1: configuring, building"
  began=$(date +%s)
  log=$(mktemp)
  cmake --preset "$1" -DCONTCT_BUILD_TESTS=ON "-DCONTCT_LONG_TESTS=${2:-OFF}" >"$log" 2>&1 && cmake --build --preset "$1" >>"$log" 2>&1 ||
    { cat "$log"; rm -f "$log"; echo "== $1: the build failed" >&2; exit 1; }
  sed -n 's/^-- skipped: //p' "$log" >>"$skipped"
  rm -f "$log"
  echo "== $1: $(($(date +%s) - began)) s"
}

# test_of NAME: tests the build of this preset, and prints ctest's summary.
test_of() {
  echo "== $1: testing"
  ctest --preset "$1" -j "$(nproc 2>/dev/null || echo 2)" --progress
}

# leg NAME COMMAND..: runs a command, which exits 77 if its tool is missing.
leg() {
  echo "== $1"
  began=$(date +%s)
  name=$1
  shift
  "$@" && status=0 || status=$?
  [ $status != 77 ] || { echo "$name" >>"$skipped"; return; }
  [ $status = 0 ] || { echo "== $name: FAILED (exit status $status)" >&2; exit $status; }
  echo "== $name: $(($(date +%s) - began)) s"
}

for name in $legs; do
  build "$name"
  test_of "$name"
done
[ "$full" = yes ] || [ -z "$legs" ] || exit 0
if [ "$full" = no ]; then
  build release
  test_of release
  echo "== $(($(date +%s) - started)) s; the long tests are in sh tests/run.sh --full"
  exit 0
fi

need_for_long_tests
need "for more compilers" flang-16
need_languages
sh tests/tree/format.sh
build release ON
# The campaigns run beside what needs other tools: each of the two leaves a processor idle most of the time.
beside=$(mktemp)
{
  leg "20,000 random problems and their certificates against the exact path" build/release/tests/contct_referee 20000 2026
  leg "failing system calls" python3 tests/faults/faults.py build/release/contct build/release/tests/libcontct_fail.so \
    build/release/tests/plugins/libvariant_reassociated.so --more
  leg "mutants of both kernels" python3 tests/mutants/mutants.py build/release/tests/mutants/build.json
  leg "every mutant is not proved" /usr/bin/python3 -B tests/prove/faults.py "$PWD/build/release" "$PWD" all
  leg "exact numbers of verification.toml" python3 tests/results/write_exact.py build/release/contct reference --check --least 733
  leg "proofs of all reference problems" python3 tests/proof/check_proof_test.py build/release/contct reference all
  leg "two LAPACKs" sh tests/two_lapacks/run.sh build/release
  leg "the same programs from another folder" sh tests/package/same_binaries.sh build/release
} >"$beside" 2>&1 &
lane=$!
trap 'kill $lane 2>/dev/null' EXIT
leg "CalculiX and Siconos as peers" sh tests/peer/run.sh build/release
leg "other processors" sh tests/emulated/run.sh
leg "the page in a browser" sh tests/browser/run.sh build/release
leg "the playground in a browser" sh tests/playground/run.sh build/release
leg "grids read back by VTK" sh tests/vtk/run.sh build/release
leg "the harness on a second routine" sh reference/course/second/run.sh
leg "fuzzers" sh tests/fuzz/run.sh 60
leg "Debian packages" sh tests/package/debian.sh
leg "reference/adopt" sh tests/package/adopt.sh
sh tests/tree/tidy.sh
wait $lane || { cat "$beside"; exit 1; }
trap - EXIT
cat "$beside"
test_of release
[ ! -s "$skipped" ] || sed 's/^/== skipped, because a tool is not available: /' "$skipped"
echo "== $(($(date +%s) - started)) s"
