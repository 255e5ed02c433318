#!/bin/sh
# Records whole paths into reference/traces. The calls' inputs come from solves, and differ in the last digits between
# LAPACKs; a kernel's answers to equal inputs do not differ. usage: sh tests/golden/paths.sh [PROGRAM]
set -eu
cd "$(dirname "$0")/../.."
program=${1:-build/release/contct}
for name in pb01-cantilever-tip-stop pb05-cantilever-over-flat-obstacle pb07-three-gap-supports \
  pb06-settled-middle-support pp02a-settled-column-n4; do
  "$program" run "reference/problems/$name.toml" --quiet --trace "reference/traces/path-$name.trace" || test $? -le 3
done
