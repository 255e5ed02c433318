"""everywhere.py PROGRAM: tests that every quantity of a result has the same value in each output that has room for it: a
beam, a plate and a matrix are written as JSON, and their numbers are found again in the tables of --csv, in the grid of
--vtu and in the data of --html, to the bit, and in the tables of --detail as these round, with the unit of `quantities`."""
import csv
import os
import re
import sys
import tempfile
import xml.etree.ElementTree as xml
from collections import namedtuple
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, parsed, run  # noqa: E402
from kinds import BED, CLAMP, EDGE, EVEN, FILES, MATRIX, OF_DOF, PULL, SECTION, STOP, THICK, UNDER, UNITS  # noqa: E402

PROBLEMS = {
    "beam": UNITS + SECTION + CLAMP + STOP.replace("1e4", "1e20") + STOP.replace("-1e-4", "-1") + BED + "[[hinge]]\nnode = 3\nstiffness = 900\n" + EVEN + "point = [ { x = 3.3, w = -2 } ]\n",
    "plate": UNITS + THICK + EDGE + UNDER + UNDER.replace("below", "above").replace("-", "") + BED + EVEN,
    "matrix": UNITS + MATRIX + 'coordinates = "k.xyz"\n' + OF_DOF + OF_DOF.replace("-1e-3", "-9") + '[[support]]\ndof = "2.2"\nspring = 3\n[[support]]\ndof = "2.6"\nspring = 3\n' + PULL}
DOFS = {"beam": ["w", "theta"], "plate": ["w", "wx", "wy"]}
# What has no place in an output. "force" of an increment in CSV is the sum of the loads; VTU has no moments at dofs of a matrix.
NO_ROOM = {"csv": set(), "vtu": {"beds", "hinges", "structure", "reaction_moment of a matrix"}, "html": set(), "detail": {"face"}}

# The outputs of a run: the kind of its problem, the results of --json and in the page of --html, the text of --detail.
outputs = namedtuple("outputs", "kind result page detail")

# Each function `in_..` below returns the numbers of a quantity in an output, and the numbers that it should have.


def in_result(kind, result, row):
    """Returns the numbers of a quantity at the end of the first step; None for a support with the other kind of reaction."""
    step, key = result["steps"][0], row["key"]
    if row["on"] == "supports":
        turns = lambda r: r["dof"][-1] in "456" if kind == "matrix" else r["dof"] != "w"
        return [r["value"] if turns(r) == (key == "reaction_moment") else None for r in step["reactions"]]
    if row["on"] == "beds":
        return [bed["pressure"]["max"]["value"] if key == "bed_pressure" else bed[key.removeprefix("bed_")] for bed in step["beds"]]
    if row["on"] == "hinges":
        return [hinge[key.removeprefix("hinge_")] for hinge in step["hinges"]]
    return {"nodes": lambda: step[key], "pairs": lambda: [pair[key] for pair in step["pairs"]],
            "element_ends": lambda: [x for element in step["elements"] for x in element[key]],
            "structure": lambda: [step["balance"][key.removeprefix("sum_of_")]]}[row["on"]]()


def in_csv(of, row, wanted):
    key, column = row["key"], {"theta": "slope"}.get(row["key"], row["key"])
    table = lambda name: list(csv.DictReader(Path(f"o{name}.csv").open(newline="", encoding="utf-8")))
    if row["on"] in ("supports", "beds", "hinges", "structure"):
        lines = [line for line in table(".supports") if line["on"] == row["on"] and line["step"] == "1"]
        return [line[key] for line in lines], ["" if x is None else f"{x:.6g}" for x in wanted]
    if row["on"] == "pairs":
        return [float(line[key]) for line in table(".pairs")[-len(wanted):]], wanted
    lines = table(".states")
    if of.kind == "matrix":
        return [float(line["value"]) for line in lines], wanted
    if of.kind == "beam":
        at = [(int(line["element"]), int(line["node"]), float(line[column])) for line in lines if line["node"]]
        if row["on"] == "element_ends":
            return [value for _, _, value in at], wanted
        return [value for _, _, value in sorted({node: (e, node, value) for e, node, value in at}.values(), key=lambda a: a[1])], wanted
    if row["on"] == "element_ends":  # at a node, the largest magnitude of the elements there
        most = [0.0] * 9  # nodes of 2 by 2 elements
        for first, corners in zip((0, 1, 3, 4), (wanted[i:i + 4] for i in range(0, 16, 4))):
            for node, value in zip((first, first + 1, first + 4, first + 3), corners):
                most[node] = value if abs(value) > abs(most[node]) else most[node]
        wanted = most
    return [float(line[key]) for line in lines], wanted


def in_html(of, row, wanted):
    return in_result(of.kind, of.page, row), wanted


def in_vtu(of, row, wanted):
    arrays = {a.get("Name"): [float(x) for x in a.text.split()] for a in xml.parse("o.vtu").getroot().iter("DataArray") if a.get("type") == "Float64"}
    if of.kind != "matrix" and row["on"] != "supports":  # cells are first elements, then pairs
        found = arrays[row["key"]]
        return found[-len(wanted):] if row["on"] == "pairs" else found[:len(wanted)], wanted
    if row["on"] == "pairs":
        return arrays[row["key"]][-len(wanted):], wanted
    at = lambda label, array: array[3 * (int(label[0]) - 1) + (int(label[2]) - 1) % 3]
    if row["on"] == "nodes":
        return [at(label, arrays["rotation" if label[2] > "3" else "displacement"]) for label in FILES["k.dof"].split()], wanted
    known = [(r, value) for r, value in zip(of.result["steps"][0]["reactions"], wanted) if value is not None]
    if of.kind == "matrix":
        return [at(r["dof"], arrays["reaction"]) for r, _ in known], [value for _, value in known]
    dofs = DOFS[of.kind]
    return [arrays["reaction"][(r["node"] - 1) * len(dofs) + dofs.index(r["dof"])] for r, _ in known], [value for _, value in known]


def in_detail(of, row, wanted):
    lines, node = of.detail.splitlines(), "dof" if of.kind == "matrix" else "node"
    if row["on"] in ("beds", "hinges", "structure"):
        pattern = {"bed_force": r"bed \d+ +force (\S+){}", "bed_pressure": r"pressure \S+ to (\S+){}", "bed_contact": r"; (\S+){} in contact",
                   "hinge_rotation": r"hinge \d+ +rotation ([^\s,]+){}", "hinge_moment": r"rotation \S+ moment (\S+){}"}.get(
            row["key"], row["key"].removeprefix("sum_of_") + r" (\S+){}")
        text = re.sub(r"\n +", " ", of.detail)  # these lines are wrapped
        return re.findall(pattern.format(re.escape(row["unit"] and " " + row["unit"])) + r"(?![^\s,;])", text), [f"{x + 0.0:.6g}" for x in wanted]
    if row["on"] == "element_ends":
        return [x for line in lines if re.match(rf" {{10}}{row['key']} ", line) for x in line.split()[1:]], [f"{x:.7g}" for x in wanted]
    starts = {"pairs": ["pair", node], "supports": [node, "dof"], "nodes": [node, "w"]}[row["on"]]
    head = next(i for i, line in enumerate(lines) if line.split()[:2] == starts)
    end = re.search(rf" {row['key']}(?= |$)", lines[head]).end()
    return [line[end - 14:end].strip() for line in lines[head + 1:head + 1 + len(wanted)]], ["" if x is None else f"{x:.7g}" for x in wanted]


OUTPUTS = {"csv": in_csv, "vtu": in_vtu, "html": in_html, "detail": in_detail}
program, check = Path(sys.argv[1]).resolve(), Checks()
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name, content in FILES.items():
        Path(name).write_text(content)
    for kind, text in PROBLEMS.items():
        Path("p.toml").write_text(text)
        detail = run(program, "run", "p.toml", "--detail", "--json", "o.json", "--csv", "o.csv", "--vtu", "o.vtu", "--html", "o.html", status=0).stdout
        result, page = (parsed(text) for text in (Path("o.json").read_text(), Path("o.html").read_text().split('id="data">')[1].split("</script>")[0]))
        check(result["quantities"] == page["quantities"], f"{kind}: the quantities of the page")
        for row in result["quantities"]:
            values = in_result(kind, result, row)
            check(any(values), f"{kind}, {row['key']}: a number that is not 0")
            for output, numbers_in in OUTPUTS.items():
                if not NO_ROOM[output] & {row["on"], row["key"], f"{row['key']} of a {kind}"}:
                    found, wanted = numbers_in(outputs(kind, result, page, detail), row, values)
                    if check(found == wanted, f"{kind}, {row['key']} in {output}: found {found}; allowed: {wanted}"):
                        check.counted[f"{output}_numbers"] += len(wanted)
        check.counted["quantities"] += len(result["quantities"])
check.end(210, csv_numbers=225, vtu_numbers=270, html_numbers=300, detail_numbers=290, quantities=47)
