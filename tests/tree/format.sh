#!/bin/sh
# Fails unless every source is as clang-format writes it. This takes a second or two.
set -eu
cd "$(dirname "$0")/../.."
. cpp/install.sh
need "for the sources' form" clang-format
sources=$(find cpp tests -name '*.[ch]pp' -o -name '*.[ch]')
count=$(echo "$sources" | wc -l)
[ "$count" -ge 300 ] || { echo "found $count sources; allowed: 300 or more" >&2; exit 1; }
echo "$sources" | xargs clang-format --dry-run --Werror
echo "clang-format: $count sources"
