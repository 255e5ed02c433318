#!/bin/sh
# contributing.sh SOURCE CONTCT: tests that each example in reference/CONTRIBUTING.md has at most 20 lines, that the C++
# compiles without warnings, and that the problem has the numbers of its verification.
set -eu
source=$1
contct=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
awk '/^```(cpp|toml)$/ { name = sprintf("%d.%s", ++count, substr($0, 4)); next } /^```/ { name = "" } name != "" { print >name }' \
  "$source/reference/CONTRIBUTING.md"
for file in *.cpp *.toml; do
  lines=$(grep -c . "$file")
  [ "$lines" -le 20 ] || { echo "$file: found an example of $lines lines; allowed: 20" >&2; cat "$file" >&2; exit 1; }
done
sources=0
for file in *.cpp; do
  $CXX -std=c++20 -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Werror -fsyntax-only \
    -I "$source/cpp" "$file"
  sources=$((sources + 1))
done
mkdir -p reference/problems
set -- *.toml
[ "$sources" = 3 ] && [ $# = 2 ] || { echo "found $sources sources and $# files; allowed: 3 and 2" >&2; exit 1; }
cp "$1" reference/problems/NAME.toml
cp "$2" reference/verification.toml
"$contct" verify --reference reference
echo "3 sources compile, 1 problem is verified"
