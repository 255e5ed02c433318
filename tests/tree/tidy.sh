#!/bin/sh
# clang-tidy over all C++ sources, including the tests. usage: tidy.sh [SOURCE...], for a quick look at these
# alone. Warnings are errors; .clang-tidy and tests/.clang-tidy say which checks. Sources of a library are
# read together, as they are compiled, so that the headers are read once for a dozen of them.
set -eu
cd "$(dirname "$0")/../.."
echo "== clang-tidy"
cmake --preset tidy -DCONTCT_BUILD_TESTS=ON >/dev/null
cp tests/.clang-tidy build/tidy/tests/.clang-tidy  # clang-tidy looks for it above the file that it reads
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ $# -gt 0 ]; then
  printf '%s\n' "$@" >"$work/files"
  count=$#
else
  # The sources of tests/package are separate projects with their own commands.
  find "$PWD/cpp" "$PWD/tests" -path '*/tests/package' -prune -o -name '*.cpp' -print | sort >"$work/sources"
  count=$(wc -l <"$work/sources")
  [ "$count" -ge 200 ] || { echo "found $count sources; allowed: 200 or more" >&2; exit 1; }
  find build/tidy -name 'unity_*_cxx.cxx' | sort >"$work/files"
  xargs sed -i '/\/generated\//d' <"$work/files"  # what is generated is not there yet
  xargs sed -n 's/^#include "\(.*\.cpp\)"$/\1/p' <"$work/files" | sort -u >"$work/together"
  comm -23 "$work/sources" "$work/together" >>"$work/files"
fi
# The commands are g++'s, and clang knows other warnings. On standard error clang-tidy prints the number of
# suppressed warnings, and more only when it fails.
if ! xargs -P "$(nproc 2>/dev/null || echo 2)" -n 1 clang-tidy --quiet -p build/tidy --checks=-bugprone-suspicious-include \
  --extra-arg=-Wno-unknown-warning-option <"$work/files" 2>"$work/said"; then
  grep -v 'warnings\{0,1\} generated\.$' "$work/said" >&2 || true
  exit 1
fi
echo "$count sources are clean"
