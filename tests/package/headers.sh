#!/bin/sh
# headers.sh SOURCE PREFIX [KIND..]: every public header that reference/library.md documents is installed and compiles
# alone, and a using-directive for the project's namespace brings no name of the library into a program's way. Nothing of
# the laboratory is installed. KIND: the folders whose headers this build does not have.
set -eu
source=$1
prefix=$2
shift 2
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
count=0
for header in $(sed -n 's/^| `\(contct\/[^`]*\)`.*/\1/p' "$source/reference/library.md"); do
  for absent in "$@"; do case $header in contct/$absent/*) continue 2 ;; esac; done
  [ -f "$prefix/include/$header" ] || { echo "$header is documented, and not installed" >&2; exit 1; }
  case $header in
    *.h) printf '#include <%s>\nint main(void) { return 0; }\n' "$header" >"$work/alone.c"
      # shellcheck disable=SC2086
      $CC $CFLAGS -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" "$work/alone.c" ;;
    *) printf '#include <%s>
struct call {}; struct load {}; struct table {}; struct event {}; struct change {}; struct kernel {};
struct beam {}; struct problem {}; struct observer {}; struct increment {};
void fill(call, load, table, event, change, kernel, beam, problem, observer, increment);
void wrap(call c, load l, table t, event e, change h, kernel k, beam b, problem p, observer o, increment i) {
  fill(c, l, t, e, h, k, b, p, o, i);
}
' "$header" >"$work/alone.cpp"
      # shellcheck disable=SC2086
      $CXX $CXXFLAGS -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" "$work/alone.cpp" ;;
  esac
  count=$((count + 1))
done
[ "$count" -ge 20 ] || { echo "only $count headers were compiled" >&2; exit 1; }
if find "$prefix" -path '*lab*' | grep . >&2; then
  echo "the laboratory is installed (above)" >&2
  exit 1
fi
echo "$count public headers compile alone"
