#!/bin/sh
# The Debian packages: made, judged by lintian, then installed, used and removed in a bare Debian.
# usage: sh tests/package/debian.sh [BUILD]
# BUILD: a build of the preset "package", which is brought up to date and packed; without it everything is built anew in
# build/package.
# Exit 0: all is as it should be; 77: skipped, a tool cannot be had; 1 otherwise.
# What is mounted is mounted in a namespace of this script's own, and is gone when it ends, however it ends.
set -u
if [ "${CONTCT_NAMESPACE:-}" != own ] && [ "$(id -u)" = 0 ]; then
  # In a chroot, whose root is not a mount, nothing can be made private; what is mounted is unmounted at the end anyway.
  for propagation in private unchanged; do
    ! unshare --mount --propagation $propagation true 2>/dev/null ||
      CONTCT_NAMESPACE=own exec unshare --mount --propagation $propagation sh "$0" "$@"
  done
  echo "Debian packages: SKIPPED: mounts of our own are not allowed"
  exit 77
fi
[ $# = 0 ] || given=$(cd "$1" && pwd) || exit 1
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.." || exit 1
. cpp/install.sh

skip() { echo "Debian packages: SKIPPED: $1"; exit 77; }
fail() { echo "Debian packages: $1" >&2; exit 1; }
# value NAME: of what the system says of itself
value() { sed -n "s/^$1=\"\{0,1\}\([^\"]*\)\"\{0,1\}$/\1/p" /etc/os-release; }
[ "$(value ID)" = debian ] || skip "this is no Debian, and has packages for itself only"
[ "$(id -u)" = 0 ] || skip "only root can make a bare Debian"
sources=/etc/apt/sources.list.d/debian.sources
[ -f $sources ] || skip "$sources is not there"
need "to make and check packages" dpkg-dev lintian debootstrap python3 || skip "lintian or debootstrap cannot be had"
need "for all that the packages offer" libsuitesparse-dev libgmp-dev || skip "libraries cannot be had"

log=$(mktemp)
trap 'rm -f "$log"' EXIT
trap 'exit 1' HUP INT TERM
if [ $# = 0 ]; then
  given=$PWD/build/package
  rm -rf "$given"
  cmake --workflow --preset package >"$log" 2>&1
else
  rm -f "$given"/*.deb
  { cmake --build "$given" && (cd "$given" && cpack -G DEB); } >"$log" 2>&1
fi || { tail -n 40 "$log"; fail "they are not made"; }
set -- "$given"/*.deb
[ $# = 3 ] || fail "found $# packages in $given, allowed: 3"
work=$given/bare
mkdir -p "$work/again" || exit 1

echo "-- packed again, they are the same to the byte"
(cd "$given" && cpack -G DEB -B "$work/again" >"$log" 2>&1) || { cat "$log"; fail "they cannot be packed again"; }
for package in "$@"; do cmp "$package" "$work/again/$(basename "$package")" || fail "$package differs when it is packed again"; done
installed=$work/installed
rm -rf "$installed"
for package in "$@"; do dpkg-deb -x "$package" "$installed" || exit 1; done
count=$(find "$installed" -type f | wc -l)
[ "$count" -ge 200 ] || fail "found $count files in the packages, allowed: 200 or more"
if grep -rlF -e "$PWD" "$installed" >&2; then fail "the folder of the sources is named in what is installed (above)"; fi
echo "$count files, none of which names $PWD"

echo "-- lintian"
# Debian has no bug that asks for the packages; their pages are Markdown, which doc-base does not take; and C and C++ programs
# need no gfortran, so it is recommended instead. The compiler stores a text as constants of 16 bytes, whose ends lintian takes for
# misspelt words of the programs.
lintian --no-cfg --pedantic --display-info --display-experimental --tag-display-limit 0 \
  --fail-on error,warning,info,pedantic,experimental --suppress-tags \
  initial-upload-closes-no-bugs,possible-documentation-but-no-doc-base-registration,missing-prerequisite-for-gfortran-module,spelling-error-in-binary \
  "$@" || fail "lintian has tags for them"

# A bare Debian like this one: its base is kept for the next time, what is done in it is not.
echo "-- a bare Debian $(value VERSION_CODENAME)"
root=$work/root
base=$given/../bare-$(value VERSION_CODENAME).tar
remove_root() {
  umount "$root/proc" "$root/dev" 2>/dev/null
  rm -rf --one-file-system "$root"
}
remove_root
if [ ! -s "$base" ]; then
  mirror=$(sed -n 's/^URIs: *//p' $sources | head -n 1)
  debootstrap --variant=minbase --include=ca-certificates "$(value VERSION_CODENAME)" "$root" "$mirror" >"$log" 2>&1 ||
    { tail -n 5 "$log"; skip "debootstrap finds no Debian at $mirror"; }
  umount "$root/proc" "$root/sys" 2>/dev/null  # what debootstrap leaves
  tar -C "$root" --one-file-system -cf "$base.part" . && mv "$base.part" "$base" || exit 1
else
  mkdir -p "$root" && tar -C "$root" -xf "$base" || exit 1
fi
trap 'rm -f "$log"; remove_root' EXIT
# The network and apt are set up as they are here.
cp /etc/hosts /etc/resolv.conf "$root/etc/" && rm -f "$root/etc/apt/sources.list" &&
  cp $sources "$root/etc/apt/sources.list.d/" && cp -r /etc/apt/apt.conf.d "$root/etc/apt/" || exit 1
[ ! -d /usr/local/share/ca-certificates ] || cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"
mount -t proc proc "$root/proc" && mount -t tmpfs tmpfs "$root/dev" || exit 1
for device in null zero full random urandom tty; do cp -a "/dev/$device" "$root/dev/$device"; done
ln -s /proc/self/fd "$root/dev/fd"

mkdir "$root/given" && cp "$@" "$root/given/" && cp -r "$here" "$root/given/tests" &&
  cp reference/problems/pb07-three-gap-supports.toml "$root/given/tests/pb07.toml" || exit 1
env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  chroot "$root" sh /given/tests/in_debian.sh >"$log" 2>&1 </dev/null
status=$?
grep -e '^-- ' "$log"
[ $status = 0 ] || { grep -v -e '^-- ' "$log" | tail -n 30; fail "in a bare Debian: exit $status"; }
echo "Debian packages: passed"
