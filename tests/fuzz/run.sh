#!/bin/sh
# Feeds every reader with inputs that libFuzzer makes up, under AddressSanitizer and
# UndefinedBehaviorSanitizer: sh tests/fuzz/run.sh [SECONDS] [NAME]...
# SECONDS: for each fuzzer, 60 unless given; NAME: of tests/fuzz/targets.txt, all unless given.
# Inputs are kept in build/fuzz-corpus; CONTCT_CORPUS in the environment names another folder.
# Exit 0: nothing found; 1: an input that is not handled, takes 10 s or 2.5 GiB, or a fuzzer with too few runs; 2: usage;
# 77: skipped, clang or libFuzzer cannot be had.
set -u
cd "$(dirname "$0")/../.." || exit 1
. cpp/install.sh

need "to fuzz" clang python3 || true
empty='extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }'
if ! echo "$empty" | clang++ -x c++ -fsanitize=fuzzer,address,undefined - -o /dev/null 2>/dev/null; then
  echo "fuzzers: SKIPPED: clang++ with libFuzzer is not found and cannot be installed"
  exit 77
fi
need_core || exit 1
need_program || exit 1

log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { cmake --preset fuzz && cmake --build --preset fuzz; } >"$log" 2>&1; then
  tail -n 30 "$log"
  echo "fuzzers: they do not build" >&2
  exit 1
fi
python3 tests/fuzz/fuzzers.py build/fuzz/tests/fuzz "${CONTCT_CORPUS:-build/fuzz-corpus}" "$@"
