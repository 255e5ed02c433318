#!/bin/sh
# contributing.sh SOURCE CONTCT: tests that each example in reference/CONTRIBUTING.md has at most 20 lines, that the C++
# compiles without warnings, that the patch applies and compiles, and that the problem has the numbers of its verification.
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
# The patch has no line numbers: each added line stands before the line of context that follows it.
python3 - "$source" "$source/reference/CONTRIBUTING.md" <<'EOF'
import re, sys
source, page = sys.argv[1:]
patch = re.search(r"```diff\n--- a/(\S+)\n(.*?)```", open(page).read(), re.S)
text, added = open(f"{source}/{patch[1]}").read(), ""
for line in patch[2].splitlines()[1:]:
    if line[:1] == "+":
        added += line[1:] + "\n"
    elif line[:2] != "@@":
        assert text.count("\n" + line[1:]) == 1, f"the patch: found no line {line[1:]!r}"
        text, added = text.replace("\n" + line[1:], "\n" + added + line[1:]), ""
open("patched.cpp", "w").write(text)
EOF
grep -q bed_mean patched.cpp
$CXX -std=c++20 -ffp-contract=off -Wall -Wextra -Werror -c -I "$source/cpp" patched.cpp
mkdir -p reference/problems
set -- *.toml
[ "$sources" = 3 ] && [ $# = 2 ] || { echo "found $sources sources and $# files; allowed: 3 and 2" >&2; exit 1; }
cp "$1" reference/problems/NAME.toml
cp "$2" reference/verification.toml
"$contct" verify --reference reference
echo "3 sources and a patch compile, 1 problem is verified"
