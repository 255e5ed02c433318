#!/bin/sh
# pages.sh SOURCE PROGRAMS PAGE LEAST [HEADING]: runs the commands that a page shows, as they stand there: its sh blocks,
# and what the CI jobs of its yaml blocks run. Every one must end with 0, and there must be LEAST or more. With HEADING, of
# that section alone. What installs and builds this project is left out: PROGRAMS has it built. A command that the page
# shows twice is run once. The script of a GitLab job is one command: its lines share variables, and it ends where one exits.
set -eu
source=$(cd "$1" && pwd)
programs=$(cd "$2" && pwd)
page=$source/$3

commands() {
  awk -v only="${5:-}" '
    /^## / { here = $0 == "## " only }
    function left_out(line) { return line ~ /^(sh contct\/cpp\/run\.sh$|apt-get |git clone )/ }
    function end_script() { if (script) print job; script = 0; job = "" }
    /^```/ { end_script(); kind = substr($0, 4); steps = 0; next }
    only != "" && !here { next }
    kind == "sh" { line = line $0; if (sub(/\\$/, "", line)) next; print line; line = "" }
    kind != "yaml" { next }
    match($0, /^ *shard: \[/) { shards = split(substr($0, RLENGTH + 1, index($0, "]") - RLENGTH - 1), shard, ", "); next }
    /^ *script:$/ { script = 1; next }
    script && !/^ *- / { end_script() }
    script && sub(/^ *- /, "") { if (!left_out($0)) job = job (job == "" ? "" : "; ") $0; next }
    !sub(/^ *- run: /, "") || left_out($0) { next }
    !/matrix\.shard/ { print; next }
    { for (i = 1; i <= shards; ++i) { one = $0; gsub(/\$\{\{ matrix\.shard \}\}/, shard[i], one); print one } }
  ' "$page" | awk '!seen[$0]++'
}

# The folder that the pages speak of: a project of its own with this one in contct/, and this one.
there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
cd "$there"
mkdir -p contct/build/release
for name in CMakeLists.txt cpp fortran reference; do ln -s "$source/$name" contct/; done
for name in contct contct-replay; do ln -s "$programs/$name" contct/build/release/; done
ln -s contct/cpp contct/reference contct/build .
cp "$source/reference/kernels/contct_kernel.c" mine.c
export CALLS=8000 GITHUB_STEP_SUMMARY="$there/step_summary"

commands "$@" >commands
count=$(wc -l <commands)
[ "$count" -ge "$4" ] || { echo "$3: found $count commands, allowed: $4 or more" >&2; exit 1; }
while IFS= read -r command; do
  echo "\$ $command"
  sh -eu -c "$command" </dev/null
done <commands
echo "$3: all $count commands ran"
