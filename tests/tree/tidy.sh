#!/bin/sh
# clang-tidy over all C++ sources, with the commands of a build folder (default build/release).
# Warnings are errors; .clang-tidy says which checks.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build/release}
echo "== clang-tidy"
[ -f "$build/compile_commands.json" ] || { echo "$build has no compile_commands.json: build it first" >&2; exit 1; }
# On standard error clang-tidy counts the warnings that it leaves out; only when it fails is there more.
said=$(mktemp)
if ! find cpp -name '*.cpp' | sort |
  xargs -P "$(nproc 2>/dev/null || echo 2)" -n 4 clang-tidy --quiet -p "$build" \
    --extra-arg=-Wno-unknown-warning-option 2>"$said"; then # the commands are g++'s
  grep -v 'warnings\{0,1\} generated\.$' "$said" >&2 || true
  rm -f "$said"
  exit 1
fi
rm -f "$said"
count=$(find cpp -name '*.cpp' | wc -l)
[ "$count" -ge 30 ] || { echo "only $count sources were looked at" >&2; exit 1; }
echo "$count sources are clean"
