# man.sh PROGRAM CHECKER...: the manual page is one that CHECKER has nothing to say of, and it says what --help says.
set -eu
program=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
page=$folder/contct.1 # mandoc takes what stands behind the point for the section
"$program" man >"$page"
said=$("$@" "$page" 2>&1) || { echo "$said" >&2; exit 1; }
[ -z "$said" ] || { echo "$said" >&2; exit 1; }
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
[ "$count" -gt 40 ] || { echo "only $count options were looked at" >&2; exit 1; }
