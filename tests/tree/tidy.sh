#!/bin/sh
# Runs clang-tidy on all C++ sources and tests. usage: tidy.sh [SOURCE...], for these sources only. Warnings are errors;
# .clang-tidy and tests/.clang-tidy list the checks. The sources of a room are read together, as they are compiled.
set -eu
cd "$(dirname "$0")/../.."
echo "== clang-tidy"
rm -rf build/tidy  # it may have unity sources of an older list
cmake --preset release -B build/tidy -DCONTCT_BUILD_TESTS=ON >/dev/null
cp tests/.clang-tidy build/tidy/tests/.clang-tidy  # clang-tidy looks for it in the folders above a source
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ $# -gt 0 ]; then
  printf '%s\n' "$@" >"$work/files"
  count=$#
else
  # The sources of tests/package are separate projects.
  find "$PWD/cpp" "$PWD/tests" -path '*/tests/package' -prune -o -name '*.cpp' -print | sort >"$work/sources"
  count=$(wc -l <"$work/sources")
  [ "$count" -ge 150 ] || { echo "found $count sources; allowed: 150 or more" >&2; exit 1; }
  find build/tidy -name 'unity_*_cxx.cxx' | sort >"$work/files"
  xargs sed -i '/\/generated\//d' <"$work/files"  # generated sources do not exist yet
  xargs sed -n 's/^#include "\(.*\.cpp\)"$/\1/p' <"$work/files" | sort -u >"$work/together"
  comm -23 "$work/sources" "$work/together" >>"$work/files"
fi
# The compile commands are for g++, and clang does not know all its warnings. clang-tidy prints the number of suppressed
# warnings to standard error, which is shown only if it fails.
if ! xargs -P "$(nproc 2>/dev/null || echo 2)" -n 1 clang-tidy --quiet -p build/tidy --checks=-bugprone-suspicious-include \
  --extra-arg=-Wno-unknown-warning-option <"$work/files" 2>"$work/said"; then
  grep -v 'warnings\{0,1\} generated\.$' "$work/said" >&2 || true
  exit 1
fi
echo "$count sources are clean"
