#!/bin/sh
# Replays the golden set on other processors: contct-replay alone, by Debian's cross compilers, under qemu-user.
# Usage: sh tests/emulated/run.sh [aarch64] [ppc64le] [riscv64] [s390x]     (default: all four)
# What cannot be had is skipped and said so; it never counts as passed. Exit 0: all that ran are equal to the
# bit, and at least one ran; 1 otherwise; 2 usage.
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
set -- "$@" --  # behind it: the traces
for trace in reference/traces/*.trace; do
  [ -f "$trace" ] || { echo "reference/traces has no trace: nothing to replay" >&2; exit 1; }
  set -- "$@" "$trace"
done
need "to configure and build" cmake ninja-build libcli11-dev libfmt-dev || exit 1

log=$(mktemp)
report=$(mktemp)
trap 'rm -f "$log" "$report"' EXIT

# build FOLDER PROCESSOR [cmake's arguments]: contct-replay for that processor.
build() {
  folder=$1
  preset=$2
  shift 2
  cmake --preset "$preset" -B "$folder" "$@" >"$log" 2>&1 &&
    cmake --build "$folder" --target contct-replay >>"$log" 2>&1 && return 0
  tail -n 30 "$log"
  return 1
}

# replay FOLDER PROCESSOR TRACE..: all four kernels. What the probe says of the floating point is part of it.
replay() {
  program=$1/contct-replay
  emulator=qemu-$2
  shift 2
  "$emulator" "$program" --kernel fortran,cpp,fortran-r4,cpp-r4 --markdown "$report" "$@"
}

passed=0
failed=0
skipped=0
processors=""
while [ "$1" != -- ]; do processors="$processors $1"; shift; done
shift
for processor in $processors; do
  triple=$processor
  [ "$processor" = ppc64le ] && triple=powerpc64le
  need "for $processor" "gfortran-$triple-linux-gnu" "g++-$triple-linux-gnu" qemu-user >"$log" 2>&1
  missing=""
  for tool in "$triple-linux-gnu-gfortran" "$triple-linux-gnu-g++" "qemu-$processor"; do
    command -v "$tool" >/dev/null 2>&1 || missing="$missing $tool"
  done
  if [ -n "$missing" ]; then
    echo "== $processor: SKIPPED, not found and not installable:$missing"
    tail -n 2 "$log"
    skipped=$((skipped + 1))
    continue
  fi
  echo "== $processor"
  : >"$report"
  if build "build/$processor" "$processor" && replay "build/$processor" "$processor" "$@" &&
    grep -q '^- floating point: strict$' "$report"; then
    passed=$((passed + 1))
  else
    echo "== $processor: FAILED"
    grep '^- floating point' "$report"
    failed=$((failed + 1))
    continue
  fi
  # The same with a fault: this processor has an instruction that the probe must notice.
  [ "$processor" = aarch64 ] || continue
  launcher="sh;$PWD/tests/emulated/contracting.sh"
  build "build/$processor-contracting" "$processor" "-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher" \
    "-DCMAKE_Fortran_COMPILER_LAUNCHER=$launcher" &&
    replay "build/$processor-contracting" "$processor" "$@" >/dev/null 2>&1
  if grep '^- floating point: .*contracted' "$report"; then
    echo "   that was -ffp-contract=fast, put in to be noticed: it was"
  else
    echo "== $processor: FAILED: -ffp-contract=fast is not noticed"
    passed=$((passed - 1))
    failed=$((failed + 1))
  fi
done
echo "other processors: $passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" -gt 0 ]
