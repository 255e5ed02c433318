#!/bin/sh
# refuse.sh WORK PREFIX: tests that find_package refuses unknown components and versions.
set -eu
work=$1
prefix=$2
# refused WANTED WORDS: checks that find_package(contct WANTED) fails with WORDS in its message.
refused() {
  rm -rf "$work"
  mkdir -p "$work"
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES C)\nfind_package(contct %s)\n' "$1" \
    >"$work/CMakeLists.txt"
  if "$CMAKE" -G "$GENERATOR" -S "$work" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" >"$work/said" 2>&1; then
    echo "find_package(contct $1) is not refused" >&2
    exit 1
  fi
  tr -s ' \n' ' ' <"$work/said" | grep -qF -e "$2" || { cat "$work/said" >&2; exit 1; }
}
refused "REQUIRED COMPONENTS cxx finite-volumes" 'no component "finite-volumes"; allowed: c, cxx, fortran, '
refused "REQUIRED COMPONENTS cxx finite-volumes" ', core'
refused "99.0 REQUIRED" 'requested version "99.0"'
echo "find_package refuses all of them"
