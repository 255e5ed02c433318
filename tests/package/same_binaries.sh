#!/bin/sh
# Tests that programs and libraries are the same to the bit if sources and build are in other folders.
# usage: sh tests/package/same_binaries.sh [BUILD]      (default: build/release, up to date)
# Copies the sources to a new folder, builds them there by the preset "release" and compares.
# Exit 0: all are equal; 1 otherwise.
set -u
cd "$(dirname "$0")/../.." || exit 1
given=$(cd "${1:-build/release}" && pwd) || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
title="same binaries"
log=$work/log
. tests/package/said.sh

copy=$work/a/deeper/copy
mkdir -p "$copy" && cp -r CMakeLists.txt CMakePresets.json cpp fortran reference "$copy/" || exit 1
made=$work/b
targets="contct contct-replay contct_shared"
[ ! -f "$given/contct_petsc.so" ] || targets="$targets contct_petsc"
quietly env -C "$copy" cmake --preset release -B "$made" -DCONTCT_BUILD_TESTS=OFF
# shellcheck disable=SC2086 # targets are words
quietly cmake --build "$made" --target $targets

count=0
for file in "$given/contct" "$given/contct-replay" "$given"/libcontct.so.*.*.* "$given/contct_petsc.so"; do
  [ -f "$file" ] || { [ "$file" = "$given/contct_petsc.so" ] && continue; fail "there is no file $file"; }
  other=$made/$(basename "$file")
  cmp "$file" "$other" || { strings -a "$other" | grep -F -e "$work" | sort -u | head -n 5; fail "$(basename "$file") differs in another folder"; }
  count=$((count + 1))
done
[ $count -ge 3 ] || fail "found $count files to compare, allowed: 3 or more"

echo "same binaries: $count files are the same to the bit in another folder"
