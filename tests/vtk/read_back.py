"""Reads the grids of a run with VTK's own reader and compares every number with the run's result.
usage: python3 read_back.py RESULT.json FINAL.vtu [LABELS NODES]
LABELS has the labels of the dofs of an external structure; NODES has its coordinates, or is CalculiX's input file."""
import json
import os
import sys
import xml.etree.ElementTree as xml

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

result_file, final_file = sys.argv[1:3]
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


directions = {"x": 0, "y": 1, "z": 2, "1": 0, "2": 1, "3": 2, "r": 5}


def read_structure(labels_file, nodes_file):
    """Returns the labels of dofs, {node: place}, and the edges of bricks, or None instead if the file has only
    coordinates."""
    labels = open(labels_file, encoding="utf-8").read().split()
    lines = [line.strip() for line in open(nodes_file, encoding="utf-8")]
    if not nodes_file.endswith(".inp"):
        rows = [line.split() for line in lines if line and line[0] != "#"]
        return labels, {r[0]: tuple([*map(float, r[1:]), 0.0][:3]) for r in rows}, None
    places, edges, block = {}, set(), ""
    for line in lines:
        if line[:1] == "*":
            block = block if line[:2] == "**" else line.split(",")[0].upper()
        elif block == "*NODE":
            number, *at = line.split(",")
            places[number] = tuple(map(float, at))
        elif block == "*ELEMENT":
            n = line.split(",")[1:]
            for i in range(4):
                edges |= {frozenset((n[i], n[(i + 1) % 4])), frozenset((n[4 + i], n[4 + (i + 1) % 4])), frozenset((n[i], n[4 + i]))}
    return labels, places, edges


def compare_structure(grid, step, where):
    """Compares the grid of an external structure: places of nodes, displacements by labels, and pairs."""
    labels, places, edges = structure
    names = list(places)
    points = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
    assert points == [places[n] for n in names], f"{where}: the points are not the nodes"
    value = dict(zip(labels, step["displacement"]))
    read = {n: [0.0] * 6 for n in names}
    for label, u in value.items():
        node, direction = label.rsplit(".", 1)
        if node in read:
            read[node][directions[direction]] = u
    same([x for row in array(grid.GetPointData(), "displacement", 3) for x in row],
         [x for n in names for x in read[n][:3]], where + ", displacement")
    turns = any(directions[label.rsplit(".", 1)[1]] >= 3 for label in value if label.rsplit(".", 1)[0] in read)
    assert (grid.GetPointData().GetArray("rotation") is not None) == turns, where
    if turns:
        same([x for row in array(grid.GetPointData(), "rotation", 3) for x in row],
             [x for n in names for x in read[n][3:]], where + ", rotation")
    pairs, cells = step["pairs"], grid.GetCellData()
    count = grid.GetNumberOfCells() - len(pairs)
    drawn = {frozenset(names[grid.GetCell(i).GetPointId(k)] for k in (0, 1)) for i in range(count)}
    assert len(drawn) == count and count > 0, f"{where}: edges are there twice, or none"
    if edges is not None:
        assert drawn == edges, f"{where}: the edges are not the elements'"
    else:  # here members are straight, with a length of 1
        assert all(sum(abs(a - b) for a, b in zip(*(places[n] for n in e))) == 1 for e in drawn), f"{where}: {drawn}"
        assert count == len(names) - 1
    same([grid.GetCellType(i) for i in range(grid.GetNumberOfCells())], [3] * count + [1] * len(pairs), where + ", types")
    same([names[grid.GetCell(count + i).GetPointId(0)] for i in range(len(pairs))],
         [p["dof"].rsplit(".", 1)[0] for p in pairs], where + ", pairs' nodes")
    same(array(cells, "direction", 1)[count:], [directions[p["dof"].rsplit(".", 1)[1]] + 1 for p in pairs], where + ", direction")
    compare_pairs(cells, count, pairs, [value[p["dof"]] for p in pairs], where)


def compare_pairs(cells, count, pairs, w, where):
    """Compares the pairs, which are the cells after the first `count`. `w`: displacements of the pairs."""
    for name in ("pair", "gap", "force", "face"):
        same(array(cells, name, 1)[count:], [p[name] for p in pairs], f"{where}, {name}")
    same(array(cells, "surface", 1)[count:], [1 if p["surface"] == "above" else -1 for p in pairs], where + ", surface")
    same(array(cells, "state", 1)[count:],
         [2 if abs(p["face"] - d) < 1e-10 else 1 if p["state"] == "contact" else 0 for p, d in zip(pairs, w)],
         where + ", state")


def compare_own(grid, step, where):
    """Compares all numbers of a beam's or plate's grid with a step of the result, to the bit."""
    names = {on: [q["key"] for q in result["quantities"] if q["on"] == on] for on in ("nodes", "element_ends")}
    same([row[2] for row in array(grid.GetPointData(), "displacement", 3)], step["w"], where + ", displacement")
    for name in names["nodes"]:
        same(array(grid.GetPointData(), name, 1), step[name], where + ", " + name)
    elements, pairs, cells = step["elements"], step["pairs"], grid.GetCellData()
    assert grid.GetNumberOfPoints() == len(step["w"]) and grid.GetNumberOfCells() == len(elements) + len(pairs)
    expected_type = 3 if "theta" in names["nodes"] else 9  # VTK's line and quadrilateral
    same([grid.GetCellType(i) for i in range(grid.GetNumberOfCells())],
         [expected_type] * len(elements) + [1] * len(pairs), where + ", types")
    for i, pair in enumerate(pairs):
        same([grid.GetCell(len(elements) + i).GetPointId(0)], [pair["node"] - 1], where + ", a pair's node")
    compare_pairs(cells, len(elements), pairs, [step["w"][p["node"] - 1] for p in pairs], where)
    same(array(cells, "state", 1)[:len(elements)], [-1] * len(elements), where + ", state of elements")
    for name in names["element_ends"]:
        same([x for row in array(cells, name, len(elements[0][name]))[:len(elements)] for x in row],
             [x for e in elements for x in e[name]], f"{where}, {name}")


def field(grid, name):
    return grid.GetFieldData().GetArray(name).GetTuple(0)[0]


structure = read_structure(*sys.argv[3:]) if len(sys.argv) > 3 else None
compare = compare_structure if structure else compare_own
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
        same([row[2] for row in array(grid.GetPointData(), "displacement", 3)], [0.0] * grid.GetNumberOfPoints(), "the start")
        continue
    same([field(grid, "share")], [increments[at]["fraction"]], f"{name}, share")
    if at[1] == last[at[0]]:
        compare(grid, result["steps"][at[0] - 1], f"{name}, the end of step {at[0]}")
        ends += 1
assert ends == len(result["steps"]), f"{ends} of {len(result['steps'])} steps have their final state in the collection"
begun = {at for at, i in increments.items() if i["fraction"] <= 1e-12}  # the collection has the last of these
assert {(0, 0), *increments} - begun <= seen <= {(0, 0), *increments}, "not every increment is in the collection"
print(f"   {os.path.basename(final_file)}: {len(sets)} grids, {compared} numbers equal to the bit")
