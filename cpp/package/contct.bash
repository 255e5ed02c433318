# Completion of contct for bash, with the commands and options that contct --help prints.
_contct_words() { mapfile -t COMPREPLY < <(compgen -W "$2" -- "$1"); }
_contct_files() { compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$1"); }
# Completes the last word of a comma-separated list.
_contct_list() {
  local before=''
  [[ $1 != *,* ]] || before=${1%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$2" -- "${1##*,}")
}
# Prints the type of an option's value in a help text: TEXT, INT, ..; nothing for a flag.
_contct_taken() { sed -nE "s/^  $1 ([A-Z][A-Z/]*)([ :=].*)?\$/\1/p" <<<"$help"; }
_contct() {
  local program=${COMP_WORDS[0]} cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command='' help words i
  COMPREPLY=()
  # bash splits --json=f into three words.
  if [[ $cur == '=' ]]; then cur=''; elif [[ $prev == '=' ]]; then prev=${COMP_WORDS[COMP_CWORD-2]}; fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ ${COMP_WORDS[i]} == -* ]] || { command=${COMP_WORDS[i]}; break; }
  done
  help=$("$program" ${command:+"$command"} --help 2>/dev/null) || return
  words=$(sed -nE 's/^  (-h,)?(--[a-z-]+).*/\2/p' <<<"$help")
  if [[ -z $command ]]; then
    _contct_words "$cur" "$(sed -nE '/^Subcommands:/,/^$/s/^  ([a-z]+) .*/\1/p' <<<"$help") $words"
    return
  fi
  case $prev in
    --kernel | --kernels) _contct_list "$cur" "$("$program" kernels | sed '1d;/^$/,$d;s/ .*//')"; return ;;
    --engine) _contct_words "$cur" "$("$program" run --help | sed -nE '/^  --engine/{n;s/.*: (.*) \[.*/\1/;s/,//gp}')"; return ;;
    --rule) _contct_words "$cur" "corrected 1989"; return ;;
    --*)
      case $(_contct_taken "$prev") in
        TEXT) _contct_files "$cur"; return ;;
        ?*) return ;;
      esac ;;
  esac
  if [[ $cur == -* || $help != *"Positionals:"* ]]; then
    _contct_words "$cur" "$words"
  elif [[ $command:$prev == new:new ]]; then
    _contct_words "$cur" "$("$program" new | sed -nE 's/^  ([a-z-]+) .*/\1/p')"
  else
    _contct_files "$cur"
  fi
}
complete -F _contct contct
