#!/bin/sh
# pkg_config.sh SOURCE WORK PCFILES: runs the compiler lines of reference/library.md on the programs in this folder, and
# then runs these programs.
set -eu
source=$1
work=$2
export PKG_CONFIG_PATH="$3"
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
cp "$here/c/mine.c" "$here/cxx/mine.cpp" "$here/fortran/mine.f90" "$work"
cd "$work"
[ "$(pkg-config --variable=libdir contct | xargs realpath)" = "$(realpath "$3/..")" ] ||
  { echo "another contct was found: $(pkg-config --variable=libdir contct)" >&2; exit 1; }

lines=0
sh "$here/page.sh" "$source" sh >lines
while read -r line; do
  rm -f a.out
  echo "$line"
  sh -c "$line ${LDFLAGS-}"
  said=$(./a.out) || { echo "$said"; exit 1; }
  echo "$said" | grep -qx '[1-9][0-9]* facts, 0 wrong'
  lines=$((lines + 1))
done <lines
[ "$lines" = 3 ] || { echo "the page shows $lines lines, not one each for C, C++ and Fortran" >&2; exit 1; }
