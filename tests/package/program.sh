#!/bin/sh
# program.sh BIN DATA VERSION: tests that the installed contct prints its version and verifies the installed problems.
# Without these problems it must name the folders that it searched.
set -eu
bin=$1
data=$2
"$bin/contct" --version
"$bin/contct" --version | grep -qx "contct $3" || { echo "the program's version is not $3" >&2; exit 1; }
"$bin/contct" verify | tail -n 4 | tr '\n' ' ' | grep '^[1-9][0-9]* numbers in [1-9][0-9]* problems; .*; 0 failed '

mkdir -p "$data/away"
mv "$data/contct" "$data/away/contct"
trap 'mv "$data/away/contct" "$data/contct"; rmdir "$data/away"' EXIT
if said=$("$bin/contct" verify 2>&1); then
  echo "verify passes without its problems" >&2
  exit 1
fi
echo "$said"
echo "$said" | grep -qF "$data/contct/reference/verification.toml"
