#!/bin/sh
# exercise.sh ROOT PROGRAMS EXERCISE FILE VERDICT: the last line of check.sh about FILE must begin with VERDICT, and its
# exit status must match VERDICT's first word: 0 right, 1 wrong, 2 not judged. Runs in a folder like the project's root
# after the release build.
set -eu
root=$(cd "$1" && pwd)
programs=$(cd "$2" && pwd)
there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
cd "$there"
for name in README.md cpp fortran reference tests; do ln -s "$root/$name" .; done
mkdir build
ln -s "$programs" build/release

status=0
sh reference/course/exercises/check.sh "$3" "$4" >said 2>&1 || status=$?
cat said
case $5 in
  right:*) allowed=0 ;;
  wrong:*) allowed=1 ;;
  *) allowed=2 ;;
esac
[ $status = $allowed ] || { echo "exit status: found $status, allowed: $allowed" >&2; exit 1; }
case $(tail -n 1 said) in
  "$5"*) ;;
  *) echo "the last line does not begin with: $5" >&2; exit 1 ;;
esac
