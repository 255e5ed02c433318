# Installs missing Debian packages, and fetches the source of LAPACK. Sourced by cpp/run.sh, tests/run.sh and others:
#     need "why" package...
# Without apt-get, `need` continues if cmake and gfortran are installed; otherwise it names the packages and fails.

need() {
  why=$1
  shift
  missing=""
  for package in "$@"; do
    command -v dpkg-query >/dev/null 2>&1 &&
      dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' && continue
    missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  if ! command -v apt-get >/dev/null 2>&1; then
    # On another system, CMake decides whether the installed packages suffice.
    if command -v cmake >/dev/null 2>&1 && command -v gfortran >/dev/null 2>&1; then
      echo "not Debian: continuing with the installed packages ($why; on Debian:$missing)"
      return 0
    fi
    echo "Please install the equivalents of these Debian packages ($why):$missing" >&2
    return 1
  fi
  if [ "$(id -u)" = 0 ]; then
    root=""
  elif command -v sudo >/dev/null 2>&1; then
    root="sudo"
  else
    echo "Please install, as root ($why): apt-get install$missing" >&2
    return 1
  fi
  echo "installing, $why:$missing"
  $root apt-get update -qq &&
    $root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# Runs a command, and prints its output only if it fails.
silently() {
  output=$("$@" 2>&1) || { printf '%s\n' "$output"; return 1; }
}

need_core() {
  need "to build" g++ gfortran cmake ninja-build liblapack-dev libblas-dev libboost-dev
}

need_petsc() {
  need "for the engine petsc and its parallel runs" libpetsc-real-dev openmpi-bin pkgconf
}

# With GMP exact numbers are quicker; without it the program is built with Boost's integers.
need_program() {
  need "for the contct program" libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libfmt-dev libgmp-dev
}

# The packages of the long tests. Fails if Debian has one that cannot be installed.
need_for_long_tests() {
  need "for the long tests" pkgconf groff-base mandoc python3-pytest python3-numpy python3-scipy python3-pandas python3-matplotlib \
    python3-getfem mypy libsuitesparse-dev chromium fonts-dejavu-core poppler-utils emscripten f2c libf2c2-dev \
    libfast-float-dev librange-v3-dev ca-certificates calculix-ccx clang clang-tidy gfortran-aarch64-linux-gnu \
    g++-aarch64-linux-gnu qemu-user dpkg-dev lintian debootstrap && need_petsc
}

# The languages of the judges in reference/vectors; Debian 12 has no Julia.
need_languages() {
  for language in go:golang-go octave-cli:octave rustc:rustc node:nodejs; do
    command -v "${language%:*}" >/dev/null 2>&1 || need "for a judge of reference/vectors" "${language#*:}" || return 1
  done
}

# Fetches the source of reference LAPACK from Debian to $lapack. Must be called in the project's root. Does not change
# the lists of packages of the system.
fetch_lapack() {
  sources=$(pwd)/build/playground/sources
  lapack=$sources/lapack
  [ ! -d "$lapack" ] || return 0
  echo "fetching the source of LAPACK"
  mkdir -p "$sources/lists/partial" "$sources/from"
  { cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null | sed -n 's/^deb /deb-src /p'; } >"$sources/from/source.list"
  for file in /etc/apt/sources.list.d/*.sources; do
    [ ! -e "$file" ] || sed 's/^Types:.*/Types: deb-src/' "$file" >"$sources/from/${file##*/}"
  done
  set -- -qq -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$sources/from" -o "Dir::State::Lists=$sources/lists"
  apt-get "$@" update && (cd "$sources" && apt-get "$@" source --download-only lapack 2>/dev/null) &&
    mkdir -p "$lapack.part" && tar -C "$lapack.part" --strip-components=1 -xf "$sources"/lapack_*.orig.tar.gz &&
    mv "$lapack.part" "$lapack"
}
