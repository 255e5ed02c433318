#!/bin/sh
# Tests contct-replay as one static file, and the jobs of reference/adopt, in an empty root folder and in a bare Debian.
# usage: sh tests/package/adopt.sh
# Exit 0: all checks passed; 77: skipped, a tool is missing; 1 otherwise.
set -u
title="adopting"
. "$(dirname "$0")/bare.sh"
cd "$(dirname "$0")/../.." || exit 1
. cpp/install.sh
can_be_bare
need "to link a static program, and for a bare Debian" g++ gfortran cmake ninja-build libcli11-dev libfmt-dev binutils debootstrap python3 ||
  skip "debootstrap or a compiler is not available"

work=$(mktemp -d)
log=$work/log
root=$work/bare
trap 'remove_root; rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
echo "-- the static program"
program=build/static/contct-replay
quietly cmake --workflow --preset static
mkdir -p "$work/copy/deeper" && cp -r CMakeLists.txt CMakePresets.json cpp fortran reference "$work/copy/deeper" || exit 1
quietly env -C "$work/copy/deeper" cmake --preset static -B "$work/again"
quietly cmake --build "$work/again" --target contct-replay
cmp $program "$work/again/contct-replay" || fail "the program differs if it is built in another folder"
size=$(stat -c %s $program)
[ "$size" -lt 2000000 ] || fail "found $size bytes, allowed: fewer than 2000000"
readelf -lW $program >"$log" || exit 1
! grep -q -e INTERP -e DYNAMIC "$log" || fail "$program is not static"
ends 0 "50 passed, 0 failed" $program --kernel fortran,cpp,fortran-r4,cpp-r4 reference/traces/*.trace
echo "the static program has $size bytes, the same bytes if it is built in another folder"

for language in c fortran python; do
  quietly python3 tests/vectors/consumers.py . $language "" $program
  faults=$(sed -n "s/^$language: \([0-9]*\) faults are found$/\1/p" "$log")
  [ "$faults" -ge 12 ] && [ "$(grep -c "{'vectors': 1, 'static replay': 1}" "$log")" = "$faults" ] ||
    { cat "$log"; fail "$language: found $faults faults; allowed: 12 or more, each found by both"; }
done
echo "the static program and the vectors find at least twelve faults each in C, Fortran and Python"

echo "-- in an empty root folder"
empty=$work/empty
mkdir "$empty" && cp $program reference/traces/*.trace "$empty" || exit 1
cp reference/kernels/contct_kernel.c "$work/good.c"
sed 's/epsgap = 1e-10/epsgap = 1e-9/' "$work/good.c" >"$work/bad.c"
! cmp -s "$work/good.c" "$work/bad.c" || fail "the fault was not planted"
for kernel in good bad; do
  quietly cc -O2 -ffp-contract=off -static -I cpp -o "$empty/$kernel" reference/adopt/pipe_main.c "$work/$kernel.c" -lm
done
traces=$(cd reference/traces && ls ./*.trace)
# shellcheck disable=SC2086 # traces are words
{
  ends 0 "15 passed, 0 failed, 10 skipped" chroot "$empty" ./contct-replay --kernel pipe:./good $traces
  ends 1 "IF (ABS(GAP).LT.EPSGAP)" chroot "$empty" ./contct-replay --kernel pipe:./bad $traces
  ends 2 "a static program cannot load a shared library" chroot "$empty" ./contct-replay --kernel plugin:./good ./ties.trace
}
echo "a kernel that is CONTCT passes; a fault is found, and its IF named"

echo "-- in a bare Debian"
make_bare "build/bare-$(value VERSION_CODENAME).tar"
mkdir "$root/project" "$root/job" && cp -r reference cpp "$root/project" && cp $program "$root/usr/bin/" || exit 1
quietly in_bare sh -c "$(sed -n 's/^RUN //p' reference/adopt/Dockerfile)"
cp "$work/bad.c" "$root/job/mine.c" || exit 1
ends 1 "223 calls, 10 differ" in_bare sh /project/reference/adopt/judge.sh /job/mine.c
quietly in_bare cc -O2 -ffp-contract=off -I /project/cpp -o /job/mine /project/reference/adopt/pipe_main.c /job/mine.c -lm
ends 1 "IF (ABS(GAP).LT.EPSGAP)" in_bare sh -c "contct-replay --kernel pipe:/job/mine /project/reference/traces/*.trace"
echo "a fault is found twice, and its IF named"

echo "-- the jobs of reference/adopt, line by line in the bare Debian"
quietly in_bare sh -c 'apt-get update -qq && apt-get install -y -qq --no-install-recommends git'
quietly in_bare sh -c 'cd /project && git init -q && git add . && git -c user.name=a -c user.email=a@b commit -qm "what is here"'
quietly python3 tests/vectors/adopt.py /project /usr/bin/contct-replay "$root"
cat "$log"
echo "$title: passed"
