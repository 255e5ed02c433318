#!/bin/sh
# package.sh WHAT ARGUMENT..: a test of the installed project, which is one of the functions below. The environment has
# CMAKE and GENERATOR, and for some tests CC, CXX and their flags.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
fail() { echo "$1" >&2; exit 1; }
# right_facts PROGRAM: runs a program that prints how many facts it checked, and how many of them were wrong.
right_facts() {
  said=$("$1") || fail "$said"
  echo "$said" | grep -x '[1-9][0-9]* facts, 0 wrong'
}
# block KIND [HEADING]: prints the block of this kind (sh, cmake, c, cpp, fortran) of library.md of $source, by default that
# under "In your own program".
block() {
  awk -v fence="\`\`\`$1" -v heading="## ${2:-In your own program}" '/^## /{here = $0 == heading} /^```/{inside = here && $0 == fence; next} inside' \
    "$source/reference/library.md"
}

# install SOURCE BUILD FIRST PREFIX: installs the build into FIRST, moves it to PREFIX, and checks that no installed
# file names SOURCE, BUILD or FIRST.
install() {
  rm -rf "$3" "$4"
  DESTDIR='' "$CMAKE" --install "$2" --prefix "$3" >/dev/null
  mkdir -p "$(dirname "$4")"
  mv "$3" "$4"
  for place in "$1" "$2" "$3"; do  # only in text files: a library may contain a path for the debugger
    ! grep -rIF -e "$place" "$4" >&2 || fail "$place is named by what was installed (above)"
  done
  # No file may name a library by its full path, which may differ on another system.
  ! grep -rInE '/[^ ;"]*/lib[^/ ;"]+[.](a|so)([^a-z]|$)' "$4" --include='*.cmake' --include='*.pc' |
    grep -v '_IMPORT_PREFIX}/' >&2 || fail "a library is named by its full path (above)"
  for name in contct/kernel/contct.h contct/kernel/plugin.h contct/kernel/contct.hpp contct/harness/compare.hpp \
    contct/path/path.hpp contct_c.mod contct-config.cmake contct-config-version.cmake contct.pc contct-cxx.pc \
    doc/contct/LICENSE doc/contct/README.md; do
    [ -n "$(find "$4" -path "*/$name")" ] || fail "$name is not installed"
  done
  [ -z "$(find "$4" -path '*/bin/contct')" ] || [ -n "$(find "$4" -path "*/bash-completion/completions/contct" -size +0)" ] ||
    fail "bash-completion/completions/contct is not installed, or is empty"
  for page in man1/contct.1 man1/contct-replay.1 man5/contct-problem.5 man5/contct-result.5; do
    [ -z "$(find "$4" -path '*/bin/contct')" ] || gzip -t "$4/share/man/$page.gz" || fail "the manual page $page is not installed"
  done
  echo "$(find "$4" -type f | wc -l) files, none of which names where it came from"
}

# consume PROGRAM WORK PREFIX: builds and runs a program with the files installed in PREFIX by find_package.
consume() {
  components=""
  options="-Wall -Wextra -Wpedantic -Werror"
  case $1 in
    c) language=C file=mine.c library=c ;;
    cxx) language=CXX file=mine.cpp library=cxx ;;
    fortran) language=Fortran file=mine.f90 library=fortran options="-std=f2008 -Wall -Wextra -Wno-compare-reals -Werror" ;;
    problem) language=CXX file=problem.cpp library=io components=" COMPONENTS io" ;;
    serve) language=C file=serve.c library=serve components=" COMPONENTS serve" ;;
  esac
  rm -rf "$2"
  mkdir -p "$2"
  cp "$here/$file" "$2"
  sed "s/CXX/$language/; s/REQUIRED/0.2 REQUIRED$components/; s/mine.cpp/$file/; s/contct::cxx/contct::$library/; s/-Wall.*)/$options)/" \
    "$here/project.cmake" >"$2/CMakeLists.txt"
  cd "$2"
  set -- "$3" -DCMAKE_C_STANDARD=99 -DCMAKE_C_EXTENSIONS=OFF -DCMAKE_CXX_EXTENSIONS=OFF
  # A program that only calls CONTCT needs neither LAPACK nor any other library.
  if [ -z "$components" ]; then
    for package in LAPACK BLAS tomlplusplus nlohmann_json fmt; do set -- "$@" -DCMAKE_DISABLE_FIND_PACKAGE_$package=ON; done
  fi
  prefix=$1
  shift
  "$CMAKE" --no-warn-unused-cli "$@" -G "$GENERATOR" -S . -B build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
  "$CMAKE" --build build
  grep -q "^contct_DIR:PATH=$prefix/" build/CMakeCache.txt || fail "another contct was found"
  [ $language = Fortran ] || ! grep '^CMAKE_Fortran_COMPILER:' build/CMakeCache.txt ||
    fail "a project without Fortran had to look for a Fortran compiler"
  # The templates in our headers must be compiled with strict floating point.
  ! grep '"command":.*\.cpp"' build/compile_commands.json | grep -v -e ' -ffp-contract=off ' ||
    fail "a file was compiled without -ffp-contract=off (above)"
  right_facts build/mine
}

# headers SOURCE PREFIX [KIND..]: tests that every public header in reference/library.md is installed and compiles alone,
# and that no header of the laboratory is installed. KIND: a folder whose headers this build does not have.
headers() {
  source=$1 prefix=$2 count=0
  shift 2
  for header in $(sed -n 's/^| `\(contct\/[^`]*\)`.*/\1/p' "$source/reference/library.md"); do
    for absent in "$@"; do case $header in contct/$absent/*) continue 2 ;; esac; done
    [ -f "$prefix/include/$header" ] || fail "$header is documented, but not installed"
    case $header in
      *.h) compiler="$CC $CFLAGS -std=c99 -x c" ;;
      *) compiler="$CXX $CXXFLAGS -std=c++20 -x c++" ;;
    esac
    # shellcheck disable=SC2086 # flags are words
    $compiler -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" -include "$prefix/include/$header" /dev/null
    count=$((count + 1))
  done
  [ "$count" -ge 20 ] || fail "found $count headers to compile; allowed: 20 or more"
  ! find "$prefix" -path '*/lab*' | grep . >&2 || fail "files of contct/lab are installed (above)"
  echo "$count public headers compile alone"
}

# refuse WORK PREFIX: tests that find_package refuses unknown components and versions.
refuse() {
  for both in 'REQUIRED COMPONENTS cxx finite-volumes:no component "finite-volumes"; allowed: c, cxx, fortran,' \
    'REQUIRED COMPONENTS cxx finite-volumes:, core' '99.0 REQUIRED:requested version "99.0"'; do
    rm -rf "$1"
    mkdir -p "$1"
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES C)\nfind_package(contct %s)\n' "${both%%:*}" >"$1/CMakeLists.txt"
    ! "$CMAKE" -G "$GENERATOR" -S "$1" -B "$1/build" -DCMAKE_PREFIX_PATH="$2" >"$1/said" 2>&1 || fail "find_package(contct ${both%%:*}) is not refused"
    tr -s ' \n' ' ' <"$1/said" | grep -qF -e "${both#*:}" || { cat "$1/said" >&2; exit 1; }
  done
}

# pkg_config SOURCE WORK PCFILES: runs the compiler lines of reference/library.md on the programs in this folder, and then
# runs these programs.
pkg_config() {
  source=$1
  export PKG_CONFIG_PATH="$3"
  [ "$(pkg-config --variable=libdir contct | xargs realpath)" = "$(realpath "$3/..")" ] ||
    fail "another contct was found: $(pkg-config --variable=libdir contct)"
  rm -rf "$2"
  mkdir -p "$2"
  cp "$here"/mine.* "$2"
  cd "$2"
  block sh >lines
  while read -r line; do
    rm -f a.out
    echo "$line"
    sh -c "$line ${LDFLAGS-}"
    right_facts ./a.out
  done <lines
  [ "$(wc -l <lines)" = 3 ] || fail "the page shows $(wc -l <lines) lines, not one each for C, C++ and Fortran"
}

# page SOURCE: checks that every line in "In your own program" of reference/library.md is in an example program.
page() {
  source=$1
  for both in cmake:project.cmake c:mine.c cpp:mine.cpp fortran:mine.f90; do
    lines=$(block "${both%:*}" | sed 's/^ *//; s/ *$//' | grep -v '^$') || fail "the page has no ${both%:*}"
    echo "$lines" | while read -r line; do
      grep -qF -e "$line" "$here/${both#*:}" || fail "the page shows a line that ${both#*:} does not have: $line"
    done
  done
  block cpp "A beam in one header" | diff - "$here/problem.cpp" || fail "the page and problem.cpp differ (above)"
}

# program BIN DATA VERSION: tests that the installed contct prints its version and verifies the installed problems.
# Without these problems it must name the folders that it searched.
program() {
  "$1/contct" --version | grep -x "contct $3" || fail "the program's version is not $3"
  "$1/contct" verify | tail -n 4 | tr '\n' ' ' | grep '^[1-9][0-9]* numbers in [1-9][0-9]* problems; .*; 0 failed '
  data=$2
  mkdir -p "$data/away"
  mv "$data/contct" "$data/away/contct"
  trap 'mv "$data/away/contct" "$data/contct"; rmdir "$data/away"' EXIT
  ! said=$("$1/contct" verify 2>&1) || fail "verify passes without its problems"
  echo "$said" | grep -F "$data/contct/reference/verification.toml"
}

# python LIBDIR VERSION: tests that the installed contct.py finds the installed library, and has types. Exit 77 without Python 3.11.
python() {
  python3 -c 'import tomllib' 2>/dev/null || exit 77
  cd /
  found=$(env -u CONTCT_LIBRARY PYTHONPATH="$1" python3 -B -c 'import contct; print(contct.about().version, contct._library._name)')
  [ "$found" = "$2 $(realpath "$1")/libcontct.so" ] || fail "found $found; allowed: $2 $1/libcontct.so"
  [ -f "$1/contct-stubs/py.typed" ] && cmp "$1/contct.py" "$1/contct-stubs/__init__.pyi"
}

"$@"
