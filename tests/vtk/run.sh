#!/bin/sh
# Reads the grids of `contct run --vtu` back with VTK from Debian's python3-vtk9, and compares points, cells,
# displacements, pairs and elements with the run's JSON.
# usage: sh tests/vtk/run.sh [BUILD]      (default: build/release)
# Exit 0: all are equal; 77: skipped, VTK is missing; 1 otherwise.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$(cd "${1:-build/release}" && pwd) || exit 1
. cpp/install.sh

# Debian's package works only with this Python.
python=/usr/bin/python3
reads() { $python -c 'from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader' >/dev/null 2>&1; }
reads || need "to read grids back" python3-vtk9 || true
reads || { echo "VTK: SKIPPED: python3-vtk9 is not available"; exit 77; }

work=$build/tests/vtk
rm -rf "$work"
mkdir -p "$work"
wrong=0
# compare FILE [LABELS NODES]: compares the grids of a problem with its JSON.
compare() {
  name=$work/$(basename "$1")
  file=$1
  shift
  "$build/contct" run "$file.toml" --quiet --vtu "$name.vtu" --json "$name.json" 2>"$work/said" || { cat "$work/said"; wrong=1; return; }
  $python tests/vtk/read_back.py "$name.json" "$name.vtu" "$@" || { echo "VTK: $file differs"; wrong=1; }
}
for problem in pb01-cantilever-tip-stop pb05-cantilever-over-flat-obstacle pb07-three-gap-supports \
  pp03e-corners-and-settled-stop-n8 pp05a-free-plate-on-bed-n8; do
  compare reference/problems/$problem
done
# External structures with coordinates and with CalculiX's mesh.
structures=reference/structures
compare $structures/frame $structures/frame.dof $structures/frame.xyz
compare $structures/calculix/console $structures/calculix/console.dof $structures/calculix/console.inp
[ $wrong = 0 ] || { echo "VTK: FAILED"; exit 1; }
echo "VTK: passed"
