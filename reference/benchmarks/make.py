"""Writes the benchmark problems as plain data, NAME.json in this folder, and the table of reference/benchmarks.md:

    python3 reference/benchmarks/make.py            writes the files
    python3 reference/benchmarks/make.py --check    compares the existing files, and writes nothing

reference/check_problem.py reads the problem files, without the program. The exact numbers are those of
reference/verification.toml, which tests/results/write_exact.py computes by `contct exact`.
"""
import json
import sys
import tomllib
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
REFERENCE = HERE.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(REFERENCE))
sys.path.insert(0, str(HERE))
from check_problem import Problem, real  # noqa: E402
from judge import PLACE, errors  # noqa: E402

LEAST = 52
# Published sources of families of problems (PB3a and PB3b are one family), and their results.
PUBLISHED = {"pb02": "data: studysoup.com, question 142235", "pb03": "Kerr, Soicher: contact does not depend on the load",
             "pb04": "Lovtsov 2025: 0.4 F / alpha", "pb09": "Code_Aster SSNL130: -208/58875, 176/153075", "pb10": "data: Code_Aster V5.02.104",
             "pb11": "SEAINT list: 3 (B/2 - e)", "pb15": "data: Code_Aster V5.02.105", "pb16": "PETSc ex9: B - A log r", "pp01": "Dempsey 1984, abstract"}
# Families for which calculix.py was tried: at least one step of each problem does not converge.
NO_CONVERGENCE = ("pb08", "pb09", "pb11", "pb13")


class Names:
    """Names a dof by its node, from 1, and its name; a dof of a matrix by its label."""

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
        hinges = {problem.lines[0].index(real(hinge["x"])) + 1: float(hinge.get("stiffness", 0)) for hinge in toml.get("hinge", [])}
        elements = [element for element, *_ in problem.elements]
        shear = {} if elements[0].GA is None else {"GA": [float(element.GA) for element in elements]}
        return {"kind": "beam", "x": lines[0], "EI": [float(element.EI) for element in elements], **shear, "hinges": [*hinges], **({"hinge_stiffness": [*hinges.values()]} if any(hinges.values()) else {})}
    plate = problem.elements[0][0]
    return {"kind": "plate", "x": lines[0], "y": lines[1], "D": float(plate.D), "nu": float(plate.nu)}


def pairs(problem, name):
    found = []
    for (dof, n, face, stiffness), other in zip(problem.unmoved, problem.others):
        place = {"dof" if name.labels else "node": name(dof)[0]} | ({} if other is None else {"other": name(other)[0]})
        found.append(place | {"surface": "above" if n > 0 else "below", "face": float(face), "stiffness": float(stiffness)})
    return found


def steps(problem, name):
    """Returns the consistent forces, settlements and moves at the end of each step; they are totals."""
    found = []
    for step in problem.steps:
        loads, settled, _ = problem.loads(step)
        found.append({"loads": name.each(enumerate(loads)), "settlements": name.each(settled.items()), "moves": name.each(problem.moved.items())})
    return found


def numbers(checks):
    """Returns each number once, with all values with which it is compared."""
    found = {}
    for check in checks:
        place = {key: check[key] for key in PLACE if key in check}
        number = found.setdefault(json.dumps(place), place | {"exact": check["exact"], "compared_with": []})
        number["compared_with"].append({key: check[key] for key in ("kind", "value", "source")})
    return list(found.values())


def problem_of(file):
    """Returns a problem file as plain data."""
    toml = tomllib.loads(file.read_text(), parse_float=Decimal)
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
    """Returns JSON with one line for each entry of a list of objects, so that a change affects few lines."""
    parts = []
    for key, part in value.items():
        text = json.dumps(part, ensure_ascii=False)
        if isinstance(part, list) and part and isinstance(part[0], dict):
            text = "[\n  " + ",\n  ".join(json.dumps(entry, ensure_ascii=False) for entry in part) + "\n ]"
        parts.append(f' "{key}": {text}')
    return "{\n" + ",\n".join(parts) + "\n}\n"


def row(family, problems, programs):
    """Returns the table's row of a family of problems, such as PB3a and PB3b."""
    first, title = problems[0], problems[0]["title"].partition("  ")[2] or problems[0]["title"]
    number = f"{family[:2].upper()}{int(family[2:])}"
    picture = f"![{number}](benchmarks/{family}.svg)" if (HERE / f"{family}.svg").exists() else ""
    links = [f"[{number if len(problems) == 1 else p['name'][4]}](benchmarks/{p['name']}.json)" for p in problems]
    fractions = [n for n in first["numbers"] if n["quantity"] in ("w", "force") and "/" in n["exact"]]
    shown = min(fractions, key=lambda n: len(n["exact"]), default=None)
    exact = f"{shown['quantity']}({shown.get('node', shown.get('pair'))}), step {shown['step']}: {shown['exact']}" if shown else "40 digits"
    judged = [[error for p in problems for *_, error in errors(p, of.get(p["name"], []))] for of in programs]
    theirs = [f"{len(all)} within {max(all):.0e}" if all else "no convergence" if family in NO_CONVERGENCE else "not tried" for all in judged]
    cells = [picture, f"{'' if len(problems) == 1 else number + ' '}{' '.join(links)} {title}", str(sum(len(p["numbers"]) for p in problems)),
             exact, PUBLISHED.get(family, "-"), *theirs]
    return "|" + "|".join(cells) + "|"


def page_with(table, problems):
    """Returns the text of benchmarks.md with its table renewed."""
    programs = [json.loads((HERE / name).read_text())["problems"] for name in ("calculix.json", "siconos.json")]
    families = {}
    for problem in problems:
        families.setdefault(problem["name"][:4], []).append(problem)
    rows = [row(family, of, programs) for family, of in sorted(families.items())]
    begin, end = table.index("| picture |"), table.index("\n\n", table.index("| picture |"))
    header = table[begin:end].splitlines()[:2]
    return table[:begin] + "\n".join(header + rows) + table[end:]


def main(arguments):
    check = arguments == ["--check"]
    if arguments and not check:
        return __doc__
    table = tomllib.loads((REFERENCE / "verification.toml").read_text())
    problems = [benchmark(case) for case in table["case"]]
    page = REFERENCE / "benchmarks.md"
    made = {HERE / f"{problem['name']}.json": words(problem) for problem in problems} | {page: page_with(page.read_text(), problems)}
    here = {file: file.read_text() for file in [page, *HERE.glob("p[bp][0-9]*.json")]}
    different = sorted(file.name for file in made | here if made.get(file) != here.get(file))
    if not check:
        for file, text in made.items():
            file.write_text(text)
    print(f"{len(problems)} problems; {'different' if check else 'changed'}: {', '.join(different) or 'none'}")
    return int(len(problems) < LEAST or (check and bool(different)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
