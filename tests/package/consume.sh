#!/bin/sh
# consume.sh PROGRAM WORK PREFIX: configures, builds and runs the project in the folder PROGRAM with the files installed
# in PREFIX. The program prints how many facts it checked, and how many were wrong.
set -eu
program=$1
work=$2
prefix=$3
rm -rf "$work"
# A program that only calls CONTCT needs neither LAPACK nor any other library.
set --
if ! grep -q COMPONENTS "$program/CMakeLists.txt"; then
  for package in LAPACK BLAS tomlplusplus nlohmann_json fmt; do set -- "$@" -DCMAKE_DISABLE_FIND_PACKAGE_$package=ON; done
fi
"$CMAKE" --no-warn-unused-cli "$@" -G "$GENERATOR" -S "$program" -B "$work" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
"$CMAKE" --build "$work"
grep -q "^contct_DIR:PATH=$prefix/" "$work/CMakeCache.txt" || { echo "another contct was found" >&2; exit 1; }
if ! grep -q 'LANGUAGES Fortran' "$program/CMakeLists.txt" && grep '^CMAKE_Fortran_COMPILER:' "$work/CMakeCache.txt"; then
  echo "a project without Fortran had to look for a Fortran compiler" >&2
  exit 1
fi
# The templates in our headers must be compiled with strict floating point.
if grep '"command":.*\.cpp"' "$work/compile_commands.json" | grep -v -e ' -ffp-contract=off '; then
  echo "a file was compiled without -ffp-contract=off (above)" >&2
  exit 1
fi
cd "$work"
said=$(./mine) || { echo "$said"; exit 1; }
echo "$said"
echo "$said" | grep -qx '[1-9][0-9]* facts, 0 wrong'
