#!/bin/sh
# headers.sh SOURCE PREFIX [KIND..]: tests that every public header in reference/library.md is installed and compiles
# alone, and that no header of the laboratory is installed. KIND: a folder whose headers this build does not have.
set -eu
source=$1
prefix=$2
shift 2
count=0
for header in $(sed -n 's/^| `\(contct\/[^`]*\)`.*/\1/p' "$source/reference/library.md"); do
  for absent in "$@"; do case $header in contct/$absent/*) continue 2 ;; esac; done
  [ -f "$prefix/include/$header" ] || { echo "$header is documented, but not installed" >&2; exit 1; }
  # shellcheck disable=SC2086 # flags are words
  case $header in
    *.h) $CC $CFLAGS -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" -include "$prefix/include/$header" \
      -x c /dev/null ;;
    *) $CXX $CXXFLAGS -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" -include "$prefix/include/$header" \
      -x c++ /dev/null ;;
  esac
  count=$((count + 1))
done
[ "$count" -ge 20 ] || { echo "found $count headers to compile; allowed: 20 or more" >&2; exit 1; }
if find "$prefix" -path '*/lab*' | grep . >&2; then
  echo "files of contct/lab are installed (above)" >&2
  exit 1
fi
echo "$count public headers compile alone"
