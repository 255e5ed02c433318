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

log=$(mktemp)
report=$(mktemp)
trap 'rm -f "$log" "$report"' EXIT

# build FOLDER PROCESSOR [ARGUMENT..]: builds contct-replay for this processor, with the arguments for cmake.
build() {
  into=$1
  preset=$2
  shift 2
  cmake --preset "$preset" -B "$into" "$@" >"$log" 2>&1 &&
    cmake --build "$into" --target contct-replay >>"$log" 2>&1 && return 0
  tail -n 30 "$log"
  return 1
}

# replay FOLDER PROCESSOR TRACE..: replays with all four kernels. The probe's result is part of the output.
replay() {
  program=$1/contct-replay
  emulator=qemu-$2
  shift 2
  : >"$report"
  "$emulator" "$program" --kernel fortran,cpp,fortran-r4,cpp-r4 --markdown "$report" -- "$@" >"$log" 2>&1 && return 0
  grep -v -e ': skipped: ' -e ': equal to the bit; ' "$log" | tail -n 30
  return 1
}

passed=0
failed=0
skipped=0
verdicts=""
# verdict WORDS: stores this processor's verdict, which is printed at the end.
verdict() {
  verdicts="$verdicts$(printf '%-8s %s' "$processor:" "$1")
"
}
fail() {
  failed=$((failed + 1))
  verdict "FAILED: $1"
}

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
    skipped=$((skipped + 1))
    continue
  fi
  folder=build/$processor
  if ! build "$folder" "$processor"; then fail "the build failed"; continue; fi
  if ! replay "$folder" "$processor" "$@"; then fail "$(tail -n 1 "$log")"; continue; fi
  said=$(tail -n 1 "$log")
  if ! grep -q '^- floating point: strict$' "$report"; then
    fail "$(grep '^- floating point' "$report")"
    continue
  fi
  # Each trace has one precision, so two of the four kernels must replay it.
  replays=$(grep -c ': equal to the bit; ' "$log")
  values=$(sed -n 's/.*: equal to the bit; .* \([0-9]*\) values compared, 0 mismatches$/\1/p' "$log" | awk '{n += $1} END {print n}')
  if [ "$replays" -lt $((2 * $#)) ]; then fail "only $replays replays of $# traces: $said"; continue; fi
  verdict "passed: $# traces, four kernels, $values values compared, 0 mismatches; floating point strict; $said"
  passed=$((passed + 1))
done
echo "other processors: $passed passed, $failed failed, $skipped skipped"
printf '%s' "$verdicts"
[ "$failed" = 0 ] || exit 1
[ "$passed" -gt 0 ] || exit 77
