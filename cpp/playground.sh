#!/bin/sh
# Builds the playground, build/playground/contct.html, and the course with its scenes, build/course/index.html. In these
# pages the program runs as WebAssembly, with the 1989 code and the C++ kernels. The pages need no network. Installs
# missing packages. Exit status 0: built; 77: skipped, because Emscripten or the source of LAPACK is not available.
set -eu
cd "$(dirname "$0")/.."
. cpp/install.sh

need "for the playground" emscripten cmake ninja-build f2c libf2c2-dev libboost-dev libtomlplusplus-dev \
  nlohmann-json3-dev libfmt-dev python3-markdown libfast-float-dev librange-v3-dev ca-certificates || exit 77
fetch_lapack || { echo "playground: SKIPPED: the source of LAPACK cannot be fetched" >&2; exit 77; }
echo "building in build/playground"
silently emcmake cmake -G Ninja -S cpp/playground -B build/playground -DLAPACK_SOURCE="$lapack"
silently cmake --build build/playground
ls -l build/playground/contct.html | awk '{ printf "build/playground/contct.html: %.1f MB\n", $5 / 1e6 }'
