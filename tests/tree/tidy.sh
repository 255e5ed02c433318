#!/bin/sh
# clang-tidy over all C++ sources, those of the tests too. usage: tidy.sh [SOURCE...], for a quick look at these alone.
# Warnings are errors; .clang-tidy and tests/.clang-tidy say which checks.
set -eu
cd "$(dirname "$0")/../.."
echo "== clang-tidy"
cmake --preset tidy -DCONTCT_BUILD_TESTS=ON >/dev/null
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ $# -gt 0 ]; then
  least=1
  printf '%s\n' "$@" >"$work/sources"
else
  least=200
  # What tests/package has are projects of their own, with commands of their own.
  # The one in tests/tree/semicolon is there to be refused.
  find cpp tests \( -path tests/package -o -path tests/tree/semicolon \) -prune -o -name '*.cpp' -print | sort >"$work/sources"
fi
# The commands are g++'s, and clang knows other warnings. On standard error clang-tidy counts those that it leaves out;
# only when it fails is there more.
if ! xargs -P "$(nproc 2>/dev/null || echo 2)" -n 4 clang-tidy --quiet -p build/tidy \
  --extra-arg=-Wno-unknown-warning-option <"$work/sources" 2>"$work/said"; then
  grep -v 'warnings\{0,1\} generated\.$' "$work/said" >&2 || true
  exit 1
fi
count=$(wc -l <"$work/sources")
[ "$count" -ge "$least" ] || { echo "found $count sources; allowed: $least or more" >&2; exit 1; }
echo "$count sources are clean"
