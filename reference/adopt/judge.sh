#!/bin/sh
# judge.sh SOURCE..: compares the kernel in these C sources with the vectors.
# Exit status 0: equal to the bit in every call; 1: otherwise.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cc -O2 -ffp-contract=off -I "$here/../../cpp" -o "$work/judge" "$here/../vectors/consumers/judge.c" "$@" -lm
"$work/judge" "$here/../vectors/contct-vectors-1.txt"
