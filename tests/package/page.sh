#!/bin/sh
# page.sh SOURCE: checks that every line in "In your own program" of reference/library.md is in an example program.
# page.sh SOURCE KIND: prints the block of this kind (sh, cmake, c, cpp, fortran).
set -eu
source=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)

block() {
  awk -v fence="\`\`\`$1" '/^## /{here = $0 == "## In your own program"} /^```/{inside = here && $0 == fence; next} inside' \
    "$source/reference/library.md"
}

# shown KIND FILE: checks that every line of the page's block is in FILE.
shown() {
  block "$1" | sed 's/^ *//; s/ *$//' | grep -v '^$' >lines-of-page || { echo "the page has no $1" >&2; exit 1; }
  while read -r line; do
    grep -qF -e "$line" "$here/$2" || { echo "the page shows a line that $2 does not have: $line" >&2; exit 1; }
  done <lines-of-page
}

if [ $# -gt 1 ]; then
  block "$2"
  exit
fi
cd "$(mktemp -d)"
shown cmake cxx/CMakeLists.txt
shown c c/mine.c
shown cpp cxx/mine.cpp
shown fortran fortran/mine.f90
rm -r "$PWD"
echo "the programs have all lines of the page"
