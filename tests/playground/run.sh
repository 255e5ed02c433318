#!/bin/sh
# The program as WebAssembly in a browser without a window, against the program itself: every reference problem under
# three sets of kernels, results to the bit, unit 26 byte for byte, every call; the golden set replayed; errors with
# their places; and the page as people use it. Builds the playground (cpp/playground.sh) if it is not built.
# Times are printed and not judged.
# usage: sh tests/playground/run.sh [BUILD]      (default: build/release)
# Exit 0: all is equal; 77: skipped, Emscripten or chromium cannot be had; 1 otherwise.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$(cd "${1:-build/release}" && pwd) || exit 1
. cpp/install.sh

has_browser() { command -v chromium >/dev/null 2>&1 && command -v python3 >/dev/null 2>&1; }
has_browser || need "to open pages" chromium python3 fonts-dejavu-core || true
has_browser || { echo "playground: SKIPPED: chromium cannot be had"; exit 77; }
[ "$(uname -m)" = x86_64 ] || { echo "playground: SKIPPED: the page's long double is that of x86_64"; exit 77; }
sh cpp/playground.sh || exit $?

# The page has reference LAPACK; so must the program, whatever this system's alternatives choose.
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
