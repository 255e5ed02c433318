# in_debian.sh: debian.sh runs this in a bare Debian with the packages in /given and this folder in /given/tests. It
# installs each package with apt, uses it, removes it, and compares the names of all files before and after.
set -eu
cd /given
export CMAKE=cmake GENERATOR=Ninja
log=/tmp/said
. tests/said.sh
# files FILE: writes the names of all files except those of apt and of the dynamic loader.
files() {
  find / -xdev \( -path /proc -o -path /dev -o -path /sys -o -path /tmp -o -path /given -o -path /var/cache -o \
    -path /var/log -o -path /var/lib/apt -o -path /var/lib/dpkg \) -prune -o -print | sort >"$1"
}
install() { quietly apt-get install -y --no-install-recommends "$@"; }
# remove PACKAGE..: removes packages and their dependencies. No new file may remain.
remove() {
  quietly apt-get purge -y "$@"
  quietly apt-get autoremove -y --purge
  files /tmp/after
  diff /tmp/before /tmp/after || fail "$*: files are left behind (>) or missing (<), above"
  echo "-- $*: removed; the $(wc -l </tmp/after) names of files are the same as before"
}
says() { ends 0 "$@"; }
quietly apt-get update
quietly apt-get install -y ca-certificates
problems=/usr/share/contct/reference/problems

files /tmp/before
install ./contct_*.deb
cd /tmp
says "contact force 121.401           pair 1, node 5 below" contct run $problems/pb07-three-gap-supports.toml
says "fortran and cpp are equal to the bit; 8 calls" contct run $problems/pb07-three-gap-supports.toml
says "3/38" contct exact $problems/pb07-three-gap-supports.toml
says "libcholmod" ldd /usr/bin/contct
contct verify | tee verified | tail -n 4 | tr '\n' ' ' | grep -q '^7[0-9][0-9] numbers in 5[0-9] problems; .*; 0 failed ' ||
  { tail -n 4 verified; fail "contct verify: failed"; }
says "0 mismatches" contct-replay /usr/share/contct/reference/traces/ties.trace
for link in problems structures traces; do [ -d /usr/share/doc/contct/reference/$link/. ] || fail "the link $link is broken"; done
[ -f /usr/share/doc/contct/reference/CHANGELOG.md ] || fail "the pages are not installed"
rm verified
cd /given
echo "-- contct: runs, verifies and replays"
remove contct

install man-db bash-completion
files /tmp/before
install ./contct_*.deb
for page in "1 contct" "1 contct-replay" "5 contct-problem" "5 contct-result"; do
  # shellcheck disable=SC2086
  says "/usr/share/man/man${page%% *}/contct" man -w $page
done
says "/usr/share/man/man1/contct.1.gz" man -w contct-replay
says "-F _contct contct" bash -c '. /usr/share/bash-completion/bash_completion; _completion_loader contct; complete -p contct'
echo "-- contct: man and bash find their files"
remove contct

install g++ cmake ninja-build pkgconf
files /tmp/before
install ./libcontct-dev_*.deb
count=0
for program in c cxx problem; do
  quietly sh tests/package.sh consume $program /tmp/$program /usr
  rm -r /tmp/$program
  count=$((count + 1))
done
cd /tmp
quietly sh -c 'cc /given/tests/mine.c $(pkg-config --cflags --libs contct)'
says "facts, 0 wrong" ./a.out
quietly sh -c 'g++ -std=c++20 /given/tests/mine.cpp $(pkg-config --cflags --libs contct-cxx)'
says "facts, 0 wrong" ./a.out
rm a.out
cd /given
echo "-- libcontct-dev: $count programs find it by CMake, 2 by pkg-config"

install gfortran
quietly sh tests/package.sh consume fortran /tmp/fortran /usr
rm -r /tmp/fortran
echo "-- libcontct-dev: a program in Fortran finds its module"
remove libcontct-dev gfortran

install python3
files /tmp/before
install ./python3-contct_*.deb
problem="'/given/tests/pb07.toml'"
says "30.0" python3 -c "import contct; print(round(contct.run($problem).steps[1].pairs[0].force, 9))"
says "3/38" python3 -c "import contct; print(contct.exact($problem).steps[1].increments[0].fraction)"
[ -d /usr/lib/python3/dist-packages/__pycache__ ] || fail "the module is not compiled"
echo "-- python3-contct: runs, and gives exact numbers"
remove python3-contct
