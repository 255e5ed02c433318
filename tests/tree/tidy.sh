#!/bin/sh
# clang-tidy over all C++ sources, those of the tests too. usage: tidy.sh [BUILD [SOURCE...]], with the commands of a build
# folder (default build/release) and, for a quick look, of these sources alone.
# Warnings are errors; .clang-tidy and tests/.clang-tidy say which checks.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build/release}
[ $# = 0 ] || shift
echo "== clang-tidy"
[ -f "$build/compile_commands.json" ] || { echo "$build has no compile_commands.json: build it first" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The commands are g++'s: clang reads headers that they precompile as text, and knows other warnings.
sed 's/ -Winvalid-pch -include [^ ]*cmake_pch\.hxx//' "$build/compile_commands.json" >"$work/compile_commands.json"
if [ $# -gt 0 ]; then
  least=1
  printf '%s\n' "$@" >"$work/sources"
else
  least=200
  # What tests/package has are projects of their own, with commands of their own.
  find cpp tests -path tests/package -prune -o -name '*.cpp' -print | sort >"$work/sources"
fi
# On standard error clang-tidy counts the warnings that it leaves out; only when it fails is there more.
if ! xargs -P "$(nproc 2>/dev/null || echo 2)" -n 4 clang-tidy --quiet -p "$work" \
  --extra-arg=-Wno-unknown-warning-option <"$work/sources" 2>"$work/said"; then
  grep -v 'warnings\{0,1\} generated\.$' "$work/said" >&2 || true
  exit 1
fi
count=$(wc -l <"$work/sources")
[ "$count" -ge "$least" ] || { echo "found $count sources; allowed: $least or more" >&2; exit 1; }
echo "$count sources are clean"
