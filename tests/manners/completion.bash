# completion.bash PROGRAM: what bash offers, in a real bash.
set -eu
source <("$1" completion bash)

# offered WORDS...: what comes for the last of these words.
offered() {
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  _contct
  echo "${COMPREPLY[*]-}"
}

# expect WANTED WORDS...
failures=0
expect() {
  local wanted=$1 got
  shift
  got=$(offered "$@")
  if [ "$got" != "$wanted" ]; then
    echo "for \"$*\": offered \"$got\"; wanted \"$wanted\"" >&2
    failures=$((failures + 1))
  fi
}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
touch beam.toml "a beam.toml" other.txt

expect "run replay" contct r
expect "explain" contct expl
expect "--version" contct --v
expect "--kernels" contct run --ker
expect "--kernels" contct run beam.toml --ker
expect "--increment" contct explain --inc
expect "fortran fortran-r4" contct run --kernels fort
expect "fortran,cpp fortran,cpp-r4 fortran,corrected" contct run --kernels fortran,c
expect "fortran,cpp fortran,cpp-r4 fortran,corrected" contct run --kernels = fortran,c
expect "condensed" contct run --engine con
expect "beam.toml" contct run be
expect "a beam.toml" contct run a
expect "beam.toml" contct run --json be
expect "beam.toml" contct run --json = be
expect "beam.toml" contct run --strict be
expect "" contct run --max-increments 1
expect "beam plate" contct new ""
expect "beam.toml" contct new beam be
expect "beam.toml" contct convert be
expect "other.txt" contct convert beam.toml o
expect "bash zsh fish" contct completion ""
expect "problem result" contct man ""
expect "" contct nonsense x
for command in run explain new verify fuzz replay kernels completion man; do
  case " $(offered contct "") " in
    *" $command "*) ;;
    *) echo "$command is not offered" >&2; failures=$((failures + 1)) ;;
  esac
done
complete -p contct | grep -q -- '-F _contct contct' || { echo "bash was not told" >&2; exit 1; }
[ "$failures" = 0 ]
