#!/bin/sh
# run.sh BUILD: no fault in a kernel is proved to be CONTCT; and which preconditions the proofs need. Exit 77 without Capstone and Z3.
set -eu
/usr/bin/python3 -c "import capstone, z3" || exit 77
here=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
/usr/bin/python3 "$here/tests/prove/faults.py" "$build" "$here" all
/usr/bin/python3 "$here/tests/prove/preconditions.py" "$build"
