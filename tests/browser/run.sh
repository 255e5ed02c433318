#!/bin/sh
# Tests the page of `contct run --html` in headless chromium: the slider, every number against the run's JSON, themes,
# widths, print, accessibility, 5000 nodes, and external structures with coordinates, with CalculiX's mesh, with
# neither coordinates nor mesh, and with 20,000 edges.
# usage: sh tests/browser/run.sh [BUILD]      (default: build/release)
# Exit 0: all checks passed; 77: skipped, chromium or pdftotext is missing; 1 otherwise. Pictures are kept in
# BUILD/tests/browser.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$(cd "${1:-build/release}" && pwd) || exit 1
. cpp/install.sh

has_browser() { command -v chromium >/dev/null 2>&1 && command -v python3 >/dev/null 2>&1 && command -v pdftotext >/dev/null 2>&1; }
has_browser || need "to open pages" chromium python3 fonts-dejavu-core poppler-utils || true
has_browser || { echo "browser: SKIPPED: chromium or pdftotext is not available"; exit 77; }

work=$build/tests/browser
rm -rf "$work"
mkdir -p "$work"
wrong=0
# page NAME FILE EXIT [ARGUMENT..]: runs FILE, which must end with exit status EXIT.
page() {
  name=$1 file=$2 expected=$3
  shift 3
  "$build/contct" run "$file" --quiet --html "$work/$name.html" --json "$work/$name.json" "$@" 2>"$work/said"
  status=$?
  [ $status = "$expected" ] || { echo "browser: $name: found exit status $status; allowed: $expected"; cat "$work/said"; wrong=1; }
}
python3 tests/browser/problems.py "$work" || exit 1
for problem in pb01-cantilever-tip-stop pb05-cantilever-over-flat-obstacle pb07-three-gap-supports \
  pp03e-corners-and-settled-stop-n8 pp05a-free-plate-on-bed-n8; do
  page "${problem%%-*}" "reference/problems/$problem.toml" 0
done
for name in free close row bolts two-faces long wide bare grid crane raft places; do page $name "$work/$name.toml" 0; done
for name in slab base-plate racks rail; do page $name reference/cookbook/$name.toml 0; done
page alone "$work/alone.toml" 0 --kernels cpp
for name in settling strip; do page $name "$work/$name.toml" 0 --envelope; done
page yard "$work/yard.toml" 0 --envelope --refine
page own-ways "$work/own-ways.toml" 0 --free-run --kernels fortran,corrected
page corrected "$work/corrected.toml" 0 --kernels corrected
for name in mechanism never; do page $name "$work/$name.toml" 4; done
page frame reference/structures/frame.toml 0
page console reference/structures/calculix/console.toml 0
(cd "$work" && "$build/contct" run no-pairs.toml --quiet --html no-pairs.html) || wrong=1
python3 tests/browser/check_pages.py "$work" || wrong=1
[ $wrong = 0 ] || { echo "browser: FAILED"; exit 1; }
echo "browser: passed"
