#!/bin/sh
# check.sh EXERCISE FILE: says whether FILE is an answer to exercise a, b, c or d of reference/course/exercises.md.
# A FILE that ends in .sed edits reference/kernels/contct_kernel.c into one; for d, the problem PB7.
# From the project's root, after the release build. Exit status: 0 right, 1 wrong, 2 it could not be judged.
set -u
contct=build/release/contct
usage() { echo "usage: sh reference/course/exercises/check.sh a|b|c|d FILE, from the project's root" >&2; exit 2; }
right() { echo "right: $*"; exit 0; }
wrong() { echo "wrong: $*"; exit 1; }

[ $# = 2 ] || usage
file=$2
original=reference/kernels/contct_kernel.c
[ "$1" != d ] || original=reference/problems/pb07-three-gap-supports.toml
[ -x "$contct" ] || { echo "check.sh: found no $contct; build it: cmake --preset release && cmake --build --preset release" >&2; exit 2; }
[ -r "$file" ] || { echo "check.sh: cannot read $file" >&2; exit 2; }
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT

case $file in
  *.sed)
    sed -f "$file" $original >"$scratch/edited.c" || wrong "it does not edit $original"
    file=$scratch/edited.c ;;  # a problem, too, whatever its name
esac

# What contct calls the kernel in $file: a shared library from C or Fortran, a command otherwise.
kernel_of() {
  case $file in
    *.c) cc -std=c11 -O2 -ffp-contract=off -shared -fPIC -I cpp -o "$scratch/kernel.so" "$file" || wrong "it does not compile" ;;
    *.f90) gfortran -std=f2018 -O2 -ffp-contract=off -shared -fPIC -J "$scratch" -o "$scratch/kernel.so" "$file" ||
             wrong "it does not compile" ;;
    *.py) kernel="pipe:python3 $file"; return ;;
    *.pl) kernel="pipe:perl $file"; return ;;
    *) echo "check.sh: found $file; allowed: a file that ends in .c, .f90, .py, .pl or .sed" >&2; exit 2 ;;
  esac
  kernel=plugin:$scratch/kernel.so
}

# The golden set: the names of the traces that notice a difference.
golden_set() {
  "$contct" replay --kernel "$kernel" reference/traces/*.trace >"$scratch/replay" 2>/dev/null
  status=$?
  [ $status -lt 2 ] || wrong "contct replay ends with exit status $status"
  sed -n 's,^reference/traces/\(.*\)\.trace: .*: mismatch;.*,\1,p' "$scratch/replay"
}

# The hunt: 0 where it finds nothing, 1 where it finds a difference.
hunt() {
  "$contct" fuzz --calls "$1" --kernels "fortran,$kernel" --quiet >"$scratch/fuzz" 2>&1
  status=$?
  [ $status -lt 2 ] || wrong "contct fuzz ends with exit status $status"
  sed -n 's/^contct: call .* differs in \([A-Z]*\)([0-9]*):.*/contct fuzz notices: \1 differs/p; s/^contct: call .* differs in SMIN:.*/contct fuzz notices: SMIN differs/p' "$scratch/fuzz" | head -n 1
  return $status
}

# A kernel but for the one line that exercise (a) has broken.
but_for_that_line() { sed "$(grep -n 'epsmul) isep' $original | cut -d : -f 1)d" "$1"; }

# The problem in $file with the face at node 13 at $1.
with_face() { sed "/^node *= 13\$/,/^face/ s/^face.*/face      = $1/" "$file"; }

# Does the listing without rounding take pairs 1 and 3 together in the first increment of step 2? The share where it does.
taken_together() {
  with_face "$1" | "$contct" exact - --rule 1989 2>/dev/null | sed -n '/^step 2/{n;s/^  share \([^,]*\),.*pair 1 .* makes contact, pair 3 .* makes contact$/\1/p;}'
}

case $1 in
  a)
    but_for_that_line "$file" >"$scratch/theirs"
    but_for_that_line $original >"$scratch/ours"
    cmp -s "$scratch/theirs" "$scratch/ours" || wrong "another line is changed"
    kernel_of
    noticed=$(golden_set) || { echo "$noticed"; exit 1; }
    count=$(echo "$noticed" | grep -c .)
    echo "the golden set notices in:" ${noticed:-nothing}
    hunt 20000 && wrong "contct fuzz notices nothing: it is not broken"
    [ "$count" = 0 ] && wrong "the hunt notices, but no trace of the golden set does"
    [ "$count" = 1 ] || wrong "$count traces notice; allowed: 1"
    right "one trace notices, and the hunt does"
    ;;
  b)
    kernel_of
    noticed=$(golden_set) || { echo "$noticed"; exit 1; }
    [ -z "$noticed" ] || wrong "these traces notice a difference:" $noticed
    hunt 5000 || wrong "the golden set notices nothing, but contct fuzz does"
    right "equal to the bit, in the golden set and in 5000 calls"
    ;;
  c)
    "$contct" run "$file" --kernels fortran,cpp --strict --quiet >/dev/null 2>"$scratch/told"
    faithful=$?
    "$contct" run "$file" --kernels corrected --strict --quiet >/dev/null 2>&1
    corrected=$?
    echo "contct run --strict: the listing ends with $faithful, the corrected rule with $corrected"
    [ $faithful = 2 ] && { sed 's/^/  /' "$scratch/told"; wrong "it is no problem file"; }
    [ $faithful = 0 ] && wrong "the listing gets it right"
    [ $faithful = 3 ] || wrong "exit status of the listing: found $faithful; allowed: 3, solved but not certified"
    [ $corrected = 0 ] || wrong "exit status of the corrected rule: found $corrected; allowed: 0"
    "$contct" explain --all "$file" >"$scratch/explained" 2>/dev/null
    grep '^      TOO EARLY: it is put in contact before it touches' "$scratch/explained" | head -n 1 | grep . ||
      wrong "it goes wrong in another way: no pair is put in contact before it touches"
    right "a pair is toggled too early, and only the corrected rule is certified"
    ;;
  d)
    face=$(sed -n '/^node *= 13$/,/^face/ s/^face *= *//p' "$file")
    with_face -0.006 >"$scratch/theirs"
    cmp -s "$scratch/theirs" $original || wrong "another line is changed"
    awk -v f="$face" 'BEGIN { exit !(f ~ /^-0\.[0-9]+$/ && f <= -0.006) }' ||
      wrong "the face at node 13: found $face; allowed: a decimal, -0.006 or lower"
    share=$(taken_together "$face")
    [ -z "$share" ] || wrong "pairs 1 and 3 are still toggled together, at share $share"
    higher=$(awk -v f="$face" 'BEGIN { printf "%.9f", f + 1e-8 }')
    share=$(taken_together "$higher")
    [ -n "$share" ] || wrong "the face is too low: at $higher they are toggled apart, too"
    right "at $face they are toggled apart, at $higher still together, at share $share"
    ;;
  *) usage ;;
esac
