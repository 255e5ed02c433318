#!/bin/sh
# Compares the playground in headless chromium with the program: every reference problem with three sets of kernels,
# results to the bit, unit 26, every call, the replayed golden set, and errors with their places. Also tests the page's
# controls. Builds the playground by cpp/playground.sh if needed.
# usage: sh tests/playground/run.sh [BUILD]      (default: build/release)
# Exit 0: all are equal; 77: skipped, Emscripten or chromium is missing; 1 otherwise.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$(cd "${1:-build/release}" && pwd) || exit 1
. cpp/install.sh

has_browser() { command -v chromium >/dev/null 2>&1 && command -v python3 >/dev/null 2>&1; }
has_browser || need "to open pages" chromium python3 fonts-dejavu-core || true
has_browser || { echo "playground: SKIPPED: chromium is not available"; exit 77; }
[ "$(uname -m)" = x86_64 ] || { echo "playground: SKIPPED: this processor is not x86_64, whose long double the page has"; exit 77; }
sh cpp/playground.sh || exit $?

# The page uses reference LAPACK, so the program must use it too.
for library in lapack blas; do
  for folder in /usr/lib/*/"$library"; do
    [ -e "$folder/lib$library.so.3" ] && LD_LIBRARY_PATH=$folder${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  done
done
export LD_LIBRARY_PATH

work=$build/tests/playground_page
rm -rf "$work"
mkdir -p "$work"
python3 tests/playground/check_playground.py "$work" "$build/contct" build/playground/contct.html || { echo "playground: FAILED"; exit 1; }
python3 tests/playground/pictures.py build/course --check || { echo "playground: FAILED: the pictures of the course differ; python3 tests/playground/pictures.py build/course draws them"; exit 1; }
echo "playground: passed"
