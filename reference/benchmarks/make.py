"""Writes the benchmark problems as plain data, NAME.json in this folder, from reference/problems and reference/verification.toml:

    python3 reference/benchmarks/make.py            writes
    python3 reference/benchmarks/make.py --check    compares what is here, and writes nothing

The problem files are read without the program, by reference/check_problem.py. The exact numbers are those of the table, which
tests/lab/write_exact.py has from `contct exact`.
"""
import json
import sys
import tomllib
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
REFERENCE = HERE.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(REFERENCE))
from check_problem import Problem, real  # noqa: E402

LEAST = 50
PLACE = ("step", "quantity", "node", "pair", "element", "end", "corner", "dof", "change", "from", "along")


class Names:
    """A dof as a node from 1 and a name; of a matrix, as a label."""

    def __init__(self, problem, labels):
        self.problem, self.labels = problem, labels

    def __call__(self, dof):
        if self.labels:
            return [self.labels[dof]]
        return [dof // len(self.problem.names) + 1, self.problem.names[dof % len(self.problem.names)]]

    def each(self, values):
        return [[*self(dof), float(value)] for dof, value in values if value]


def structure(toml, problem, labels):
    if labels:
        entries = [[labels[i], labels[j], float(k)] for i, row in enumerate(problem.K) for j, k in sorted(row.items()) if j <= i and k]
        return {"kind": "matrix", "dofs": labels, "stiffness": entries}
    lines = [[float(x) for x in line] for line in problem.lines]
    if len(lines) == 1:
        # The entry for both rotations of an element of length h is 4 EI / h; a hinge at its right end leaves 3 EI / h for the left one.
        hinges = [problem.lines[0].index(real(hinge["x"])) + 1 for hinge in toml.get("hinge", [])]
        stiffness = [element.stiffness[1][1] * (b - a) / (3 if e + 2 in hinges else 4)
                     for e, ((element, _, _), a, b) in enumerate(zip(problem.elements, problem.lines[0], problem.lines[0][1:]))]
        return {"kind": "beam", "x": lines[0], "EI": [float(EI) for EI in stiffness], "hinges": hinges}
    plate = problem.elements[0][0]
    return {"kind": "plate", "x": lines[0], "y": lines[1], "D": float(plate.D), "nu": float(plate.nu)}


def pairs(problem, name):
    found = []
    for (dof, n, face, stiffness), other in zip(problem.unmoved, problem.others):
        place = {"dof": name(dof)[0], "other": name(other)[0]} if name.labels else {"node": name(dof)[0]}
        found.append(place | {"surface": "above" if n > 0 else "below", "face": float(face), "stiffness": float(stiffness)})
    return found


def steps(problem, name):
    """Totals at the end of each step; forces are the consistent ones of all loads."""
    found = []
    for step in problem.steps:
        loads, settled, _ = problem.loads(step)
        found.append({"loads": name.each(enumerate(loads)), "settlements": name.each(settled.items()), "moves": name.each(problem.moved.items())})
    return found


def numbers(checks):
    """Each once, with what it is compared with."""
    found = {}
    for check in checks:
        place = {key: check[key] for key in PLACE if key in check}
        number = found.setdefault(json.dumps(place), place | {"exact": check["exact"], "compared_with": []})
        number["compared_with"].append({key: check[key] for key in ("kind", "value", "source")})
    return list(found.values())


def problem_of(file):
    """A problem file as plain data."""
    toml = tomllib.loads(file.read_text(), parse_float=Fraction)
    problem = Problem(toml, file.parent)
    labels = (file.parent / toml["matrix"]["dofs"]).read_text().split() if "dofs" in toml.get("matrix", {}) else []
    if "matrix" in toml and not labels:
        labels = [str(i) for i in range(1, problem.n + 1)]
    name = Names(problem, labels)
    if any("state" in table for table in toml.get("contact", []) + toml.get("bed", [])):
        raise ValueError(f"{file}: found a state; allowed: none: pairs whose face is 0 are in contact")
    return {"format": "contct-benchmark-1", "name": file.stem, "title": toml["title"], "structure": structure(toml, problem, labels),
            "supports": [[*name(dof), spring and float(spring)] for dof, spring in problem.supports],
            "pairs": pairs(problem, name), "steps": steps(problem, name)}


def benchmark(case):
    return problem_of(REFERENCE / "problems" / case["file"]) | {"numbers": numbers(case["check"])}


def words(value):
    """A line for each entry of a list of objects, so that a change is a line."""
    parts = []
    for key, part in value.items():
        text = json.dumps(part, ensure_ascii=False)
        if isinstance(part, list) and part and isinstance(part[0], dict):
            text = "[\n  " + ",\n  ".join(json.dumps(entry, ensure_ascii=False) for entry in part) + "\n ]"
        parts.append(f' "{key}": {text}')
    return "{\n" + ",\n".join(parts) + "\n}\n"


def main(arguments):
    check = arguments == ["--check"]
    if arguments and not check:
        return __doc__
    table = tomllib.loads((REFERENCE / "verification.toml").read_text())
    made = {f"{Path(case['file']).stem}.json": words(benchmark(case)) for case in table["case"]}
    here = {file.name: file.read_text() for file in HERE.glob("p[bp][0-9]*.json")}
    different = sorted(name for name in made | here if made.get(name) != here.get(name))
    if not check:
        for name, text in made.items():
            (HERE / name).write_text(text)
    print(f"{len(made)} problems; {'different' if check else 'changed'}: {', '.join(different) or 'none'}")
    return int(len(made) < LEAST or (check and bool(different)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
