# Functions of scripts that run commands. $title, if set, begins a message; the output of a command goes to $log.
fail() { echo "${title:+$title: }$1" >&2; exit 1; }
quietly() { "$@" >"$log" 2>&1 || { tail -n 30 "$log"; fail "$*: failed"; }; }
# ends STATUS WORDS COMMAND..: checks that the command has this exit status, and WORDS in its output.
ends() {
  status=$1
  words=$2
  shift 2
  found=0
  "$@" >"$log" 2>&1 || found=$?
  [ $found = "$status" ] || { tail -n 20 "$log"; fail "$*: found exit status $found, allowed: $status"; }
  grep -qF -e "$words" "$log" || { tail -n 20 "$log"; fail "$*: the output has no \"$words\""; }
}
