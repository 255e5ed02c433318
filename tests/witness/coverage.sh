#!/bin/sh
# Is every line and every branch of the listing taken? Runs PROGRAM, whose listing counts what it does, and lets
# gcov look. Both counting builds, of 4 and of 8 bytes, have to be covered on their own.
# usage: coverage.sh GCOV COMPILER_VERSION WORK PROGRAM ARGUMENT..
set -eu
gcov=$1
version=$2
work=$3
shift 3
lines=30     # that gcov knows in the listing
branches=18  # two for each of its two DOs and seven IFs: fewer, and something was not looked at

"$gcov" --version | head -n 1 | grep -qwF "$version" ||
  { echo "$("$gcov" --version | head -n 1) cannot read what the compiler $version counts" >&2; exit 1; }
rm -rf "$work"
mkdir -p "$work"
# What is counted stays here: nothing of an earlier run is added, and nothing is left beside the sources.
GCOV_PREFIX=$work "$@" >"$work/said" || { cat "$work/said"; exit 1; }

cd "$work"
find . -name '*.gcda' >counted
[ "$(wc -l <counted)" = 2 ] || { echo "found $(wc -l <counted) builds of the listing that count, not 2" >&2; exit 1; }
missing=0
while read -r counts; do
  build=$(dirname "$counts")
  notes=${counts%.gcda}.gcno
  cp "${notes#.}" "$notes"
  (cd "$build" && "$gcov" -b -c "$(basename "$counts")" >summary)
  name=$(sed -n 's/^function \([a-z0-9]*\)_ .*/\1/p' "$build/contct.f.gcov")
  sed -n "s/^\(Lines\|Branches\|Taken\)\(.*\)/$name: \1\2/p" "$build/summary" | head -n 3
  # share "WORDS": "100.00% of 18" becomes "100.00 18".
  share() { sed -n "s/^$1:\([0-9.]*\)% of \([0-9]*\)$/\1 \2/p" "$build/summary" | head -n 1; }
  covered() {
    read -r percent number <<END
$(share "$1")
END
    [ "$percent" = 100.00 ] && [ "$number" -ge "$2" ]
  }
  if ! { covered "Lines executed" $lines && covered "Branches executed" $branches &&
    covered "Taken at least once" $branches; }; then
    missing=1
    echo "$name: not all of $lines lines and $branches branches are taken; what gcov has against it:"
    # A branch is told below its line.
    awk '/^ *[-#0-9]+\**:/ {line = $0} /#####:/ {print}
         /^branch .*(never executed|taken 0)/ {print line; print "   " $0}' "$build/contct.f.gcov" | uniq
  fi
done <counted
[ "$missing" = 0 ] || exit 1
echo "every line and every branch of both builds is taken"
