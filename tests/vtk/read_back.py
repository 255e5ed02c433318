"""Reads the grids of a run with VTK's own reader and compares every number with the run's result.
usage: python3 read_back.py RESULT.json FINAL.vtu"""
import json
import os
import sys
import xml.etree.ElementTree as xml

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

result_file, final_file = sys.argv[1:]
result = json.load(open(result_file, encoding="utf-8"))
compared = 0


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    assert reader.GetErrorCode() == 0 and grid.GetNumberOfPoints() > 0, f"{path}: VTK cannot read it"
    return grid


def array(data, name, components):
    values = data.GetArray(name)
    assert values is not None, f"no array {name}"
    assert values.GetNumberOfComponents() == components, (name, values.GetNumberOfComponents())
    rows = [values.GetTuple(i) for i in range(values.GetNumberOfTuples())]
    return rows if components > 1 else [row[0] for row in rows]


def same(found, expected, what):
    global compared
    compared += len(expected)
    assert list(found) == list(expected), f"{what}: found {list(found)[:6]}.., expected {list(expected)[:6]}.."


def compare(grid, step, where):
    """All of a grid with a step of the result, to the bit."""
    names = {1: [], 2: ["w", "theta"], 3: ["w", "wx", "wy"]}[len(step["displacement"]) // len(step["w"])]
    same(array(grid.GetPointData(), "w", 1), step["w"], where + ", w")
    same([row[2] for row in array(grid.GetPointData(), "displacement", 3)], step["w"], where + ", displacement")
    for i, name in enumerate(names):
        same(array(grid.GetPointData(), name, 1), step["displacement"][i::len(names)], where + ", " + name)
    elements, pairs, cells = step["elements"], step["pairs"], grid.GetCellData()
    assert grid.GetNumberOfPoints() == len(step["w"]) and grid.GetNumberOfCells() == len(elements) + len(pairs)
    expected_type = 3 if len(names) == 2 else 9  # a line, a quadrilateral
    same([grid.GetCellType(i) for i in range(grid.GetNumberOfCells())],
         [expected_type] * len(elements) + [1] * len(pairs), where + ", types")
    for i, pair in enumerate(pairs):
        same([grid.GetCell(len(elements) + i).GetPointId(0)], [pair["node"] - 1], where + ", a pair's node")
    tail = slice(len(elements), None)
    same(array(cells, "pair", 1)[tail], [p["pair"] for p in pairs], where + ", pair")
    same(array(cells, "gap", 1)[tail], [p["gap"] for p in pairs], where + ", gap")
    same(array(cells, "force", 1)[tail], [p["force"] for p in pairs], where + ", force")
    same(array(cells, "surface", 1)[tail], [1 if p["surface"] == "above" else -1 for p in pairs], where + ", surface")
    faces = array(cells, "face", 1)[tail]
    w = [step["w"][p["node"] - 1] for p in pairs]
    same(array(cells, "state", 1)[tail],
         [2 if abs(c - d) < 1e-10 else 1 if p["state"] == "contact" else 0 for p, c, d in zip(pairs, faces, w)],
         where + ", state")
    same(array(cells, "state", 1)[:len(elements)], [-1] * len(elements), where + ", state of elements")
    for name, values in elements[0].items():
        if name != "element":
            same([x for row in array(cells, name, len(values))[:len(elements)] for x in row],
                 [x for e in elements for x in e[name]], f"{where}, {name}")


def field(grid, name):
    return grid.GetFieldData().GetArray(name).GetTuple(0)[0]


compare(read(final_file), result["steps"][-1], "the final state")
stem = os.path.splitext(final_file)[0]
ends = 0
sets = list(xml.parse(stem + ".pvd").getroot().iter("DataSet"))
times = [float(d.get("timestep")) for d in sets]
assert times == sorted(set(times)), "the collection's times do not rise"
increments = {(s["step"], i["increment"]): i for s in result["steps"] for i in s["increments"]}
last = {s["step"]: len(s["increments"]) for s in result["steps"]}
seen = set()
for name in [d.get("file") for d in sets]:
    grid = read(os.path.join(os.path.dirname(final_file), name))
    at = (int(field(grid, "step")), int(field(grid, "increment")))
    seen.add(at)
    if at[0] == 0:
        same(array(grid.GetPointData(), "w", 1), [0.0] * grid.GetNumberOfPoints(), "the start")
        continue
    same([field(grid, "share")], [increments[at]["fraction"]], f"{name}, share")
    if at[1] == last[at[0]]:
        compare(grid, result["steps"][at[0] - 1], f"{name}, the end of step {at[0]}")
        ends += 1
assert ends == len(result["steps"]), f"{ends} of {len(result['steps'])} steps have their final state in the collection"
assert seen == {(0, 0), *increments}, "not every increment is in the collection"
print(f"   {os.path.basename(final_file)}: {len(sets)} grids, {compared} numbers equal to the bit")
