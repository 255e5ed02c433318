# python.sh LIBDIR VERSION: tests that the installed contct.py finds the installed library. Exit 77 without Python 3.11.
set -eu
python3 -c 'import tomllib' 2>/dev/null || exit 77
cd /
found=$(env -u CONTCT_LIBRARY PYTHONPATH="$1" python3 -B -c 'import contct; print(contct.about().version, contct._library._name)')
[ "$found" = "$2 $(realpath "$1")/libcontct.so" ] || { echo "found $found; allowed: $2 $1/libcontct.so"; exit 1; }
echo "contct.py $found"
