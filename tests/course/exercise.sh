#!/bin/sh
# exercise.sh ROOT PROGRAMS EXERCISE FILE VERDICT: the last line of check.sh about FILE must begin with VERDICT, and its
# exit status must match VERDICT's first word: 0 right, 1 wrong, 2 not judged. Runs in a folder like the project's root
# after the release build.
set -eu
there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
cd "$there"
for name in README.md cpp fortran reference tests; do ln -s "$1/$name" .; done
mkdir build
ln -s "$2" build/release
status=0
sh reference/course/exercises/check.sh "$3" "$4" >said 2>&1 || status=$?
cat said
case "$status $5" in
  "0 right:"* | "1 wrong:"* | "2 check.sh:"*) ;;
  *) echo "exit status: found $status, allowed: 0 right, 1 wrong, 2 not judged" >&2; exit 1 ;;
esac
case $(tail -n 1 said) in
  "$5"*) ;;
  *) echo "the last line does not begin with: $5" >&2; exit 1 ;;
esac
