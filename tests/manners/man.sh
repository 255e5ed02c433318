# man.sh PROGRAM CHECKER...: the manual pages are ones that CHECKER has nothing to say of, and the program's says what --help
# says.
set -eu
program=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
page=$folder/contct.1 # mandoc takes what stands behind the point for the section
"$program" man >"$page"
for file in problem result; do "$program" man $file >"$folder/contct-$file.5"; done
for checked in "$page" "$folder"/contct-*.5; do
  said=$("$@" "$checked" 2>&1) || { echo "$said" >&2; exit 1; }
  [ -z "$said" ] || { echo "$said" >&2; exit 1; }
done
count=0
for command in $("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  grep -q "^\.SS \"contct $command" "$page" || { echo "$command is not in the page" >&2; exit 1; }
  for option in $("$program" "$command" --help | sed -n 's/^  [-h,]*\(--[a-z-]*\).*/\1/p'); do
    escaped=$(echo "$option" | sed 's/-/\\\\-/g')
    sed -n "/^\.SS \"contct $command/,/^\.S/p;/^\.SS/d" "$page" | grep -q "^\\\\fB$escaped\\\\fR" ||
      { echo "$command $option is not in the page" >&2; exit 1; }
    count=$((count + 1))
  done
done
for option in $("$program" --help | sed -n 's/^  [-h,]*\(--[a-z-]*\).*/\1/p'); do
  escaped=$(echo "$option" | sed 's/-/\\\\-/g')
  sed -n "/^\.SH OPTIONS/,/^\.SH COMMANDS/p" "$page" | grep -q "^\\\\fB$escaped\\\\fR" ||
    { echo "$option is not in the page" >&2; exit 1; }
  count=$((count + 1))
done
[ "$count" -ge 80 ] || { echo "only $count options were looked at" >&2; exit 1; }
