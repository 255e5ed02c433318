# man.sh SCRIPT ROOT CHECKER...: makes the manual pages of the packages. CHECKER must accept the pages, which must have
# every heading and key of the pages from which they are made.
set -eu
script=$1
root=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
count=0
for page in "contct 1 running" "contct-problem 5 problem-file" "contct-result 5 result-file"; do
  # shellcheck disable=SC2086
  set -- $page "$@"
  made=$folder/$1.$2 # mandoc takes the section from the file's extension
  source=$root/reference/$3.md
  python3 "$script" "$1" "$2" "what it is" 1.0.0 2000-01-01 "$source" >"$made"
  shift 3
  said=$("$@" "$made" 2>&1) || { echo "$said" >&2; exit 1; }
  [ -z "$said" ] || { echo "$said" >&2; exit 1; }
  sed 's/\\f[BR]//g; s/\\-/-/g; s/\\&//g' "$made" >"$folder/plain"
  sed -n 's/^###* /.S[HS] /p' "$source" | tr -d '`' | sed 's/\[/\\[/g; s/\]/\\]/g; s/\\\[HS\\\]/[HS]/; s/.*/^&$/' >"$folder/wanted"
  sed -n 's/^| \(`[a-z_]*`[^|]*\) |.*/^\1$/p' "$source" | tr -d '`' >>"$folder/wanted"
  while read -r wanted; do
    grep -q -e "$wanted" "$folder/plain" || { echo "$made has no line $wanted" >&2; exit 1; }
    count=$((count + 1))
  done <"$folder/wanted"
done
[ "$count" -ge 250 ] || { echo "found $count headings and keys; allowed: 250 or more" >&2; exit 1; }
