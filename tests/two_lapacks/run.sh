#!/bin/sh
# Tests that the equality of the kernels does not depend on LAPACK: the same paths with this system's LAPACK and with
# OpenBLAS, in lockstep, each recording replayed without LAPACK, and the test programs of one run with the other.
# OpenBLAS is unpacked into the build, because its installation would make it this system's LAPACK.
# usage: sh tests/two_lapacks/run.sh [BUILD]      (default: build/release, built with its tests)
# Exit 0: all are equal, or a skip is reported; 1 otherwise.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$(cd "${1:-build/release}" && pwd) || exit 1
work=$build/tests/two_lapacks
rm -rf "$work"
mkdir -p "$work"

skip() {
  echo "two LAPACKs: SKIPPED: $1"
  exit 0
}
command -v apt-get >/dev/null 2>&1 && command -v dpkg-deb >/dev/null 2>&1 || skip "not a Debian system"
# As root, apt-get downloads as a separate user without write permission here; its warning is suppressed.
(cd "$work" && apt-get download libopenblas0-pthread >log 2>&1) || skip "libopenblas0-pthread cannot be fetched: $(tail -n 1 "$work/log")"
dpkg-deb -x "$work"/libopenblas0-pthread_*.deb "$work/unpacked" || skip "the package cannot be unpacked"
lapack=$(find "$work/unpacked" -name liblapack.so.3)
[ -f "$lapack" ] || skip "the package has no liblapack.so.3"
openblas=$(dirname "$lapack")

wrong=0
fail() {
  echo "two LAPACKs: $1"
  wrong=1
}
# under WHICH PROGRAM ARGUMENT..: runs a program with one of the two LAPACKs.
under() {
  which=$1
  shift
  if [ "$which" = openblas ]; then
    LD_LIBRARY_PATH=$openblas OPENBLAS_NUM_THREADS=2 "$@"
  else
    "$@"
  fi
}
# The kernels that recorded() runs in lockstep.
kernels=fortran,cpp
for other in flang f2c; do
  [ -f "$build/fortran/libcontct_$other.a" ] && kernels=$kernels,$other
done
recorded() {
  file=$work/$1-$2
  under "$1" "$build/contct" run "reference/problems/$2.toml" --kernels $kernels --quiet \
    --trace "$file.trace" --json "$file.json" >"$file.said" 2>&1
  status=$?
  # Exit statuses 3 to 5 mean no certificate, a mechanism or a cycle, which the 1989 rule may give; the kernels must
  # still be equal.
  [ $status = 0 ] || [ $status -ge 3 ] || { fail "$2 under $1: exit $status"; cat "$file.said"; }
  grep -q '"lockstep": {"calls":[1-9][0-9]*,"values_compared":[1-9][0-9]*,"mismatches":0}' "$file.json" ||
    fail "$2 under $1: lockstep is not equal: $(grep '"lockstep"' "$file.json")"
  "$build/contct-replay" --kernel $kernels --quiet -- "$file.trace" >"$file.said" 2>&1 ||
    { fail "the replay of $2, recorded under $1, fails without LAPACK"; cat "$file.said"; }
}
inputs() { grep -v '^lapack ' "$1"; }

problems=0
different=0
for problem in pb01-cantilever-tip-stop pb02-beam-over-cantilever pb03a-point-load-on-bed-l4 \
  pb05-cantilever-over-flat-obstacle pb06-settled-middle-support pb07-three-gap-supports pb11a-strip-footing-n20 \
  pp01b-simply-supported-plate-n8 pp01e-unilateral-edges-n8-k1e5 pp02b-settled-column-n8 \
  pp03e-corners-and-settled-stop-n8 pp05a-free-plate-on-bed-n8; do
  recorded reference $problem
  recorded openblas $problem
  a=$work/reference-$problem.trace
  b=$work/openblas-$problem.trace
  problems=$((problems + 1))
  inputs "$a" >"$work/a"
  inputs "$b" >"$work/b"
  cmp -s "$work/a" "$work/b" || different=$((different + 1))
done
one=$(sed -n 's/^lapack //p' "$work"/reference-*.trace | sort -u)
other=$(sed -n 's/^lapack //p' "$work"/openblas-*.trace | sort -u)
echo "   this system's: $one"
echo "   the other:     $other"
if [ $wrong = 0 ]; then
  case $one in *OpenBLAS*) skip "this system's LAPACK is OpenBLAS already; with it all was equal" ;; esac
fi
[ -n "$one" ] && [ "$one" != "$other" ] || fail "the traces do not name two different LAPACKs"
case $other in *OpenBLAS*) ;; *) fail "the other LAPACK is not OpenBLAS" ;; esac
# Solves of two LAPACKs differ in their last digits, so paths without any difference would mean that only one was used.
[ $different -gt 0 ] || fail "the numbers of every call are the same, so only one LAPACK was used"

for room in harness linear structure path proof results; do
  said=$(under openblas "$build/tests/contct_${room}_tests" 2>&1)
  [ $? = 0 ] || { fail "contct_${room}_tests fails under OpenBLAS"; echo "$said" | tail -n 40; }
  echo "   contct_${room}_tests under OpenBLAS: $(echo "$said" | grep -a 'assertion' | tail -n 1)"
done
LD_LIBRARY_PATH=$openblas ldd "$build/tests/contct_proof_tests" | grep -qF "$openblas" || fail "contct_proof_tests did not run under OpenBLAS"

[ $wrong = 0 ] || { echo "two LAPACKs: FAILED"; exit 1; }
echo "two LAPACKs: passed: $problems problems, kernels $kernels, 0 mismatches; the numbers of $different problems differ"
