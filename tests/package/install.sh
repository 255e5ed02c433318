#!/bin/sh
# install.sh SOURCE BUILD FIRST PREFIX: installs the build into FIRST, moves it to PREFIX, and checks that no installed
# file names SOURCE, BUILD or FIRST.
set -eu
source=$1
build=$2
first=$3
prefix=$4
rm -rf "$first" "$prefix"
DESTDIR='' "$CMAKE" --install "$build" --prefix "$first" >/dev/null
mkdir -p "$(dirname "$prefix")"
mv "$first" "$prefix"

# Only text files are searched: a library may contain a path for the debugger.
for place in "$source" "$build" "$first"; do
  if grep -rIF -e "$place" "$prefix" >&2; then
    echo "$place is named by what was installed (above)" >&2
    exit 1
  fi
done
# No file may name a library by its full path, which may differ on another system.
if grep -rInE '/[^ ;"]*/lib[^/ ;"]+[.](a|so)([^a-z]|$)' "$prefix" --include='*.cmake' --include='*.pc' |
  grep -v '_IMPORT_PREFIX}/' >&2; then
  echo "a library is named by its full path (above)" >&2
  exit 1
fi
for name in contct/kernel/contct.h contct/kernel/plugin.h contct/kernel/contct.hpp contct/compare/compare.hpp \
  contct/path/path.hpp contct_c.mod contct-config.cmake contct-config-version.cmake contct.pc contct-cxx.pc \
  doc/contct/LICENSE doc/contct/README.md; do
  [ -n "$(find "$prefix" -path "*/$name")" ] || { echo "$name is not installed" >&2; exit 1; }
done
if [ -n "$(find "$prefix" -path '*/bin/contct')" ]; then
  name=bash-completion/completions/contct
  [ -n "$(find "$prefix" -path "*/$name" -size +0)" ] || { echo "$name is not installed, or is empty" >&2; exit 1; }
fi
echo "$(find "$prefix" -type f | wc -l) files, none of which names where it came from"
