#!/bin/sh
# Tests contct-replay with the folders of cpp/contct compiled without strict floating point. A mismatch must be blamed
# on the environment, and not on a kernel. The folders are built as a separate project; main() and the option parser are
# linked as object files of the strict build.
# usage: run.sh KIND SOURCE WORK STRICT_REPLAY OBJECT..., with CMAKE, GENERATOR, CXX and FC set; OBJECT: objects and
# libraries for the linker.
# KIND: fused     a product in a sum is contracted; the listing has no such sum, so no result differs
#       fast      -ffast-math for compiler and linker: subnormals are flushed to zero, and the golden set differs
#       compiled  -ffast-math only for the compiler: no result differs, and only its macros show it
# Exit 77: this processor has no fused multiply-add.
set -eu
kind=$1
source=$2
work=$3
strict=$4
shift 4
slack=-ffast-math
link=""
case $kind in
  fused) slack="-march=x86-64-v3 -ffp-contract=fast"; says="contracted" ;;
  fast) link=$slack; says="flushed to zero" ;;
  compiled) says="allowed to rearrange" ;;
  *) echo "found \"$kind\"; allowed: fused, fast, compiled" >&2; exit 2 ;;
esac
if [ "$kind" = fused ]; then
  for feature in fma avx2 bmi1 bmi2 f16c movbe abm; do
    grep -qw "$feature" /proc/cpuinfo 2>/dev/null || { echo "skipped: this processor has no $feature"; exit 77; }
  done
fi

mkdir -p "$work"
launcher="sh;$source/tests/probe/slack.sh;$slack"
{
  "$CMAKE" -G "$GENERATOR" -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG" \
    -DCONTCT_REPLAY_ONLY=ON \
    -DCONTCT_FLANG=OFF -DCONTCT_F2C=OFF "-DCMAKE_CXX_COMPILER=$CXX" "-DCMAKE_Fortran_COMPILER=$FC" \
    "-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher" "-DCMAKE_Fortran_COMPILER_LAUNCHER=$launcher" &&
    "$CMAKE" --build "$work/build" --target contct_kit &&
    # shellcheck disable=SC2086 # no word where there is no flag
    "$CXX" $link -o "$work/replay" -Wl,--start-group "$work"/build/cpp/lib*.a "$work"/build/fortran/lib*.a "$@" \
      -Wl,--end-group
} >"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }

# A golden trace with a changed scale factor, which no kernel answers.
doctored=$work/doctored.trace
awk '/^smin / && !done {$0 = "smin 0x1.23p-4"; done = 1} {print}' "$source/reference/traces/layouts.trace" >"$doctored"

# replay PROGRAM TRACE..: prints the summary of the comparison, without traces of another precision.
replay() {
  program=$1
  shift
  status=0
  "$program" --kernel fortran,cpp,fortran-r4,cpp-r4 --markdown "$work/report" -- "$@" >"$work/said" 2>"$work/complaints" ||
    status=$?
  grep '\.trace: ' "$work/said" | grep -v ': skipped: ' >"$work/compared" || true
}
wrong=0
expect() {  # expect WORDS CONDITION..: checks a fact
  words=$1
  shift
  "$@" || { echo "FAILED: $words"; wrong=1; }
}
all_say() { [ -s "$work/compared" ] && ! grep -v -e "$1" "$work/compared"; }

replay "$strict" "$doctored"
expect "the strict build reports a mismatch for the doctored trace" all_say ': mismatch; '
expect "the strict build exits 1" [ $status = 1 ]

replay "$work/replay" "$doctored"
expect "this build blames the environment for the doctored trace" all_say ': environment; '
expect "this build exits 1" [ $status = 1 ]
expect "this build names the fault of its environment" grep -q "^the cause is the environment, not the kernel: .*$says" "$work/complaints"
expect "the report names the fault of the environment, too" grep -q "^- floating point: .*$says" "$work/report"

replay "$work/replay" "$source"/reference/traces/*.trace
expect "every verdict on the golden set names the environment" \
  all_say "\(: environment; \|: equal to the bit, but the environment is not strict (.*$says.*)\)"
differing=$(grep -c ': environment; ' "$work/compared" || true)
if [ "$kind" = fused ]; then
  expect "no replay of the golden set differs" [ "$differing" = 0 ]
  expect "the replay of the golden set exits 0" [ $status = 0 ]
else
  expect "a replay of the golden set differs" [ "$differing" -gt 0 ]
  expect "the replay of the golden set exits 1" [ $status = 1 ]
fi
[ $wrong = 0 ] || exit 1
echo "$kind: $(wc -l <"$work/compared") replays, $differing of them differ; every verdict names the environment: $says"
