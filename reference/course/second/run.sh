#!/bin/sh
# The eleven steps on DLASV2 of reference LAPACK: sh reference/course/second/run.sh [--no-fetch]
# Works in build/second, and compares its report with README.md. Exit status 77: skipped, the source of LAPACK cannot be had.
set -eu
cd "$(dirname "$0")/../../.."
here=reference/course/second work=build/second
. cpp/install.sh
if [ "${1:-}" = --no-fetch ]; then
  lapack=build/playground/sources/lapack
  [ -d "$lapack" ] || { echo "second: SKIPPED: $lapack is not there" >&2; exit 77; }
else
  need "for the second routine" g++ gfortran && fetch_lapack || { echo "second: SKIPPED: the source of LAPACK cannot be had" >&2; exit 77; }
fi
rm -rf "$work"
mkdir -p "$work/checked" "$work/fault"
cp "$lapack/SRC/dlasv2.f" "$lapack/INSTALL/dlamch.f" "$lapack/INSTALL/lsame.f" "$here/dlasv2.hpp" "$work"
cp "$here/dlasv2.hpp" "$work/checked"
# The comparison alone, of the harness: the linker drops functions that name kernels and traces, because lockstep.cpp calls none of them.
g++ -std=c++20 -O2 -ffp-contract=off -ffunction-sections -I cpp -c cpp/contct/harness/compare.cpp -o "$work/compare.o"

# lockstep FOLDER PORT [FLAG]: FOLDER's object of FORTRAN and the port in the folder PORT are run. FORTRAN's answers are those recorded.
lockstep() {
  g++ -std=c++20 -O2 -ffp-contract=off -I "$2" -I cpp "$here/lockstep.cpp" "$work/compare.o" "$1/dlasv2.o" "$work/dlamch.o" \
    "$work/lsame.o" ${3:-} -Wl,--gc-sections -lgfortran -o "$2/lockstep" || exit 1
  status=0
  "$2/lockstep" "$work/calls.txt" >"$2/said" 2>"$2/first" || status=$?
  (cd "$work" && sha256sum --quiet --check "../../$here/frozen.sha256") || exit 1
  return $status
}
equal() { lockstep "$@" || { cat "$2/said" "$2/first" >&2; exit 1; }; }

# fault WHAT EDIT: the port with one edit must answer something otherwise.
fault() {
  sed "$2" "$work/dlasv2.hpp" >"$work/fault/dlasv2.hpp"
  ! cmp -s "$work/dlasv2.hpp" "$work/fault/dlasv2.hpp" || { echo "second: the edit $2 changes nothing" >&2; exit 1; }
  ! lockstep "$work" "$work/fault" || { echo "second: nothing noticed: $1" >&2; exit 1; }
  echo "9 $1: $(sed -n 1p "$work/fault/said")"
}

steps() {
  (cd "$work" && sha256sum --quiet --ignore-missing --check "../../$here/frozen.sha256")
  echo "1 dlasv2.f is that of LAPACK 3.11.0"
  (cd "$work" && gfortran -O2 -ffp-contract=off -c dlasv2.f dlamch.f lsame.f)
  (cd "$work/checked" && gfortran -O0 -ffp-contract=off -fcheck=all -finit-real=snan --coverage -c ../dlasv2.f)
  equal "$work/checked" "$work/checked" --coverage
  echo "3 checked: $(sed -n 1p "$work/checked/said")"
  echo "4 statements with COMMON, DATA, SAVE, READ or WRITE: $(grep -v '^\*' "$work/dlasv2.f" | grep -cE '^ .*(COMMON|DATA|SAVE|READ|WRITE)')"
  equal "$work" "$work"
  echo "5 the $(grep -c . "$work/calls.txt") recorded calls have the same answers"
  echo "7 with -O2: $(sed -n 1p "$work/said")"
  echo "8 coverage of dlasv2.f: $(cd "$work/checked" && gcov dlasv2.gcda | sed -n 's/^\(Lines.*\) of .*/\1/p' | head -n 1)"
  fault "EPS = 2^-52" 's/0x1p-53/0x1p-52/'
  fault "sign of H by H < 0" 's/sign(1, h)/(h < 0 ? -1 : 1)/'
  fault "HA.GE.FA" 's/ha > fa/ha >= fa/'
  echo "10 $(sed -n 2p "$work/said")"
  echo "11 $(sed -n 3p "$work/checked/said")"
}

steps >"$work/report"
sed -n '/^```text/,/^```$/p' "$here/README.md" | sed '1d;$d' | diff - "$work/report" || { echo "second: README.md shows something else" >&2; exit 1; }
cat "$work/report"
