# completion.bash PROGRAM SCRIPT: tests the completions of SCRIPT in bash.
set -eu
program=$1
# shellcheck source=/dev/null
source "$2"

# offered WORDS...: prints the completions of the last word.
offered() {
  COMP_WORDS=("$program" "${@:2}")
  COMP_CWORD=$(($# - 1))
  _contct
  echo "${COMPREPLY[*]-}"
}

# expect WANTED WORDS...: checks that WANTED are the completions of the last of WORDS.
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
expect "--increment" contct explain --inc
expect "fortran fortran-r4" contct run --kernels fort
expect "fortran,cpp fortran,cpp-r4 fortran,corrected" contct run --kernels fortran,c
expect "cpp cpp-r4 corrected" contct replay --kernel c
expect "condensed" contct run --engine con
expect "corrected 1989" contct exact --rule ""
expect "beam.toml" contct run be
expect "a beam.toml" contct run a
expect "beam.toml" contct run --json be
expect "beam.toml" contct run --json = be
expect "" contct run --max-increments 1
expect "base-plate beam bed crane deep-beam matrix plate racks rail-joint rail slab" contct new ""
expect "" contct nonsense x

complete -p contct | grep -q -- '-F _contct contct' || { echo "bash was not told" >&2; exit 1; }
[ "$failures" = 0 ]
