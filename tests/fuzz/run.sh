#!/bin/sh
# Runs libFuzzer on every reader under AddressSanitizer and UndefinedBehaviorSanitizer.
# usage: sh tests/fuzz/run.sh [SECONDS] [NAME]...
# SECONDS for each fuzzer: 60 by default; NAME: a fuzzer of tests/fuzz/targets.txt, by default all.
# Inputs are kept in build/fuzz-corpus or in the folder CONTCT_CORPUS, with any failing input.
# Exit 0: no failure; 1: an input fails, takes 10 s or 2.5 GiB, or a fuzzer had too few runs; 2: usage; 77: skipped,
# clang or libFuzzer is missing.
set -u
cd "$(dirname "$0")/../.." || exit 1
. cpp/install.sh

case ${1-} in
  [0-9]*) seconds=$1; shift ;;
  *) seconds=60 ;;
esac
for name in "$@"; do
  grep -q "^$name " tests/fuzz/targets.txt || { echo "fuzzers: found $name; allowed: those of tests/fuzz/targets.txt" >&2; exit 2; }
done
need "to fuzz" clang || true
empty='extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }'
if ! echo "$empty" | clang++ -x c++ -fsanitize=fuzzer,address,undefined - -o /dev/null 2>/dev/null; then
  echo "fuzzers: SKIPPED: clang++ with libFuzzer is not found and cannot be installed"
  exit 77
fi
need_core || exit 1
need_program || exit 1

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if ! { cmake --preset fuzz && cmake --build --preset fuzz; } >"$work/log" 2>&1; then
  tail -n 30 "$work/log"
  echo "fuzzers: the build failed" >&2
  exit 1
fi
corpora=${CONTCT_CORPUS:-build/fuzz-corpus}
export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=malloc_context_size=6
wrong=0
while read -r name longest least words; do
  case $name in '#'* | '') continue ;; esac
  case " ${*:-$name} " in *" $name "*) ;; *) continue ;; esac
  seeds=$work/$name options=""
  mkdir -p "$corpora/$name" "$seeds"
  for word in $words tests/fuzz/seeds/"$name"/*; do
    case $word in
      -*) options="$options $word" ;;
      # A seed that is too long is skipped, because libFuzzer would cut it.
      *) [ ! -f "$word" ] || [ "$(wc -c <"$word")" -gt "$longest" ] || cp "$word" "$seeds" ;;
    esac
  done
  # shellcheck disable=SC2086 # options are words
  CONTCT_FUZZER=$name build/fuzz/tests/fuzz/contct_fuzzers "-max_total_time=$seconds" "-max_len=$longest" -print_final_stats=1 "-artifact_prefix=$corpora/$name-" \
    -dict=tests/fuzz/numbers.dict -timeout=10 -rss_limit_mb=2560 $options "$corpora/$name" "$seeds" >/dev/null 2>"$work/said" </dev/null ||
    { grep -v '^#' "$work/said" | tail -n 60; echo "$name: found an input that fails; it is saved as $corpora/$name-*"; wrong=1; continue; }
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/said")
  echo "$name: $runs runs in $seconds s without a failure; allowed: $((least * seconds / 60)) runs or more"
  [ "${runs:-0}" -ge $((least * seconds / 60)) ] || wrong=1
done <tests/fuzz/targets.txt
exit $wrong
