#!/bin/sh
# Replays the golden set with contct-replay for other processors, built by Debian's cross compilers and run by
# qemu-user.
# Usage: sh tests/emulated/run.sh [aarch64] [ppc64le] [riscv64] [s390x]     (default: all four)
# A processor whose tools are missing is reported as skipped. The last lines have one verdict for each processor.
# Exit 0: at least one processor ran, and all results are equal to the bit; 1: a mismatch; 2: usage; 77: none ran.
set -u
cd "$(dirname "$0")/../.." || exit 1
. cpp/install.sh

[ $# -gt 0 ] || set -- aarch64 ppc64le riscv64 s390x
for processor in "$@"; do
  case $processor in
    aarch64 | ppc64le | riscv64 | s390x) ;;
    *) echo "found \"$processor\"; allowed: aarch64, ppc64le, riscv64, s390x" >&2; exit 2 ;;
  esac
done
set -- "$@" --  # the names of the traces follow after --
for trace in reference/traces/*.trace; do
  [ -f "$trace" ] || { echo "reference/traces has no trace to replay" >&2; exit 1; }
  set -- "$@" "$trace"
done
need "to configure and build" cmake ninja-build libcli11-dev libfmt-dev || exit 1

work=$(mktemp -d)
log=$work/log
trap 'rm -rf "$work"' EXIT
# verdict WORDS: stores this processor's verdict, which is printed at the end.
verdict() { printf '%-8s %s\n' "$processor:" "$1" >>"$work/verdicts"; }

processors=""
while [ "$1" != -- ]; do processors="$processors $1"; shift; done
shift
for processor in $processors; do
  echo "== $processor: building and replaying"
  triple=$processor
  [ "$processor" = ppc64le ] && triple=powerpc64le
  need "for $processor" "gfortran-$triple-linux-gnu" "g++-$triple-linux-gnu" qemu-user >"$log" 2>&1
  missing=""
  for tool in "$triple-linux-gnu-gfortran" "$triple-linux-gnu-g++" "qemu-$processor"; do
    command -v "$tool" >/dev/null 2>&1 || missing="$missing $tool"
  done
  if [ -n "$missing" ]; then
    tail -n 2 "$log"
    verdict "skipped: not found and not installable:$missing"
    continue
  fi
  folder=build/$processor
  if ! { cmake --preset "$processor" -B "$folder" && cmake --build "$folder" --target contct-replay; } >"$log" 2>&1; then
    tail -n 30 "$log"
    verdict "FAILED: the build failed"
    continue
  fi
  : >"$work/report"
  "qemu-$processor" "$folder/contct-replay" --kernel fortran,cpp,fortran-r4,cpp-r4 --markdown "$work/report" -- "$@" >"$log" 2>&1
  status=$?
  # The probe's result is part of the output. Each trace has one precision, so two of the four kernels must replay it.
  said=$(tail -n 1 "$log")
  replays=$(grep -c ': equal to the bit; ' "$log")
  values=$(sed -n 's/.*: equal to the bit; .* \([0-9]*\) values compared, 0 mismatches$/\1/p' "$log" | awk '{n += $1} END {print n}')
  if [ $status != 0 ] || [ "$replays" -lt $((2 * $#)) ]; then
    grep -v -e ': skipped: ' -e ': equal to the bit; ' "$log" | tail -n 30
    verdict "FAILED: only $replays replays of $# traces: $said"
  elif ! grep -q '^- floating point: strict$' "$work/report"; then
    verdict "FAILED: $(grep '^- floating point' "$work/report")"
  else
    verdict "passed: $# traces, four kernels, $values values compared, 0 mismatches; floating point strict; $said"
  fi
done
echo "other processors:"
cat "$work/verdicts"
! grep -q ': *FAILED' "$work/verdicts" || exit 1
grep -q ': *passed' "$work/verdicts" || exit 77
