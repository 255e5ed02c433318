#!/bin/sh
# Builds the Debian packages, checks them with lintian, and installs, uses and removes them in a bare Debian.
# usage: sh tests/package/debian.sh [BUILD]
# BUILD: a build of the preset "package", which is updated and packed; by default build/package is built anew.
# Exit 0: all checks passed; 77: skipped, a tool is missing; 1 otherwise.
set -u
title="Debian packages"
. "$(dirname "$0")/bare.sh"
[ $# = 0 ] || given=$(cd "$1" && pwd) || exit 1
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.." || exit 1
. cpp/install.sh

can_be_bare
need "to make and check packages" dpkg-dev lintian debootstrap python3 || skip "lintian or debootstrap is not available"
need "for all that the packages offer" libsuitesparse-dev libgmp-dev || skip "libsuitesparse-dev or libgmp-dev is not available"

log=$(mktemp)
trap 'rm -f "$log"' EXIT
trap 'exit 1' HUP INT TERM
if [ $# = 0 ]; then
  given=$PWD/build/package
  rm -rf "$given"
  quietly cmake --workflow --preset package
else
  rm -f "$given"/*.deb
  quietly cmake --build "$given"
  quietly env -C "$given" cpack -G DEB
fi
set -- "$given"/*.deb
[ $# = 3 ] || fail "found $# packages in $given, allowed: 3"
work=$given/bare
mkdir -p "$work/again" || exit 1

echo "-- packed again, the packages are the same to the byte"
quietly env -C "$given" cpack -G DEB -B "$work/again"
for package in "$@"; do cmp "$package" "$work/again/$(basename "$package")" || fail "$package differs when it is packed again"; done
installed=$work/installed
rm -rf "$installed"
for package in "$@"; do dpkg-deb -x "$package" "$installed" || exit 1; done
count=$(find "$installed" -type f | wc -l)
[ "$count" -ge 200 ] || fail "found $count files in the packages, allowed: 200 or more"
if grep -rlF -e "$PWD" "$installed" >&2; then fail "installed files name the folder of the sources (above)"; fi
echo "$count files, none of which names $PWD"

echo "-- lintian"
# Reasons for the suppressed tags: no Debian bug requests these packages; their pages are Markdown, which doc-base does
# not accept; gfortran is only recommended, because C and C++ programs do not need it; text is stored in constants of 16
# bytes, whose ends lintian takes for misspelt words.
lintian --no-cfg --pedantic --display-info --display-experimental --tag-display-limit 0 \
  --fail-on error,warning,info,pedantic,experimental --suppress-tags \
  initial-upload-closes-no-bugs,possible-documentation-but-no-doc-base-registration,missing-prerequisite-for-gfortran-module,spelling-error-in-binary \
  "$@" || fail "lintian reports tags for the packages (above)"

echo "-- a bare Debian $(value VERSION_CODENAME)"
root=$work/root
trap 'rm -f "$log"; remove_root' EXIT
make_bare "$given/../bare-$(value VERSION_CODENAME).tar"

mkdir "$root/given" && cp "$@" "$root/given/" && cp -r "$here" "$root/given/tests" &&
  cp reference/problems/pb07-three-gap-supports.toml "$root/given/tests/pb07.toml" || exit 1
in_bare sh /given/tests/in_debian.sh >"$log" 2>&1 </dev/null
status=$?
grep -e '^-- ' "$log"
[ $status = 0 ] || { grep -v -e '^-- ' "$log" | tail -n 30; fail "in a bare Debian: exit $status"; }
echo "Debian packages: passed"
