"""Reads a structure given by its matrix into fractions, for check_proof.py: each dof becomes a node with the dof w."""
from fractions import Fraction as F
from pathlib import Path

from check_beam import listed, need, only, real


def entries(file, *forms):
    """Returns a Matrix Market file's header, its size, and the lines below as lists of words, without blank lines."""
    lines = [line.split() for line in file.read_bytes().split(b"\n")]
    form = b" ".join(lines[0]).decode().lower()
    need(form in [f"%%matrixmarket matrix {of}" for of in forms], f"{file.name}: {form}")
    lines = [line for line in lines[1:] if line]
    size = next(i for i, line in enumerate(lines) if not line[0].startswith(b"%"))
    return form, [int(x) for x in lines[size]], lines[size + 1:]


def rows(file):
    """Returns the rows of K, whose lower triangle is in the file."""
    _, (n, columns, count), lines = entries(file, "coordinate real symmetric")
    need(n == columns and len(lines) == count, f"{file.name}: its size is another one")
    K = [{} for _ in range(n)]
    for i, j, k in ((int(i) - 1, int(j) - 1, real(k)) for i, j, k in lines):
        need(0 <= j <= i < n and j not in K[i], f"{file.name}: an entry stands twice, or not in the lower triangle")
        K[i][j] = K[j][i] = k
    return [{i: F(0)} | row for i, row in enumerate(K)]


def vector(file, n):
    """Returns {dof: load}."""
    form, (size, columns, *count), lines = entries(file, "array real general", "coordinate real general")
    if form.split()[2] == "array":
        lines = [(i + 1, 1, *line) for i, line in enumerate(lines)]
    loads = {int(i) - 1: real(k) for i, _, k in lines}
    need((size, columns, len(lines)) == (n, 1, *(count or [n])) and len(loads) == len(lines), f"{file.name}: its size is another one")
    need(all(0 <= i < n and int(j) == 1 for i, (_, j, _) in zip(loads, lines)), f"{file.name}: a place that is none")
    return loads


def as_nodes(part, number, keys):
    """Returns the table with dofs replaced by nodes, and with fix, spring and value for w."""
    only(part, {"dof", "dofs", *keys})
    need(("dof" in part) + ("dofs" in part) == 1, "not one of dof and dofs")
    part = dict(part, nodes=[number[label.encode()] for label in listed(part.pop("dofs", part.pop("dof", None)))])
    if "other" in part:
        part["other"] = [number[label.encode()] - 1 for label in listed(part["other"])]
    if "fix" in part:
        need(part["fix"] is True and "spring" not in part, "fix is not true, or beside a spring")
        part["fix"] = "w"
    return part | {new: {"w": part.pop(old)} if new == old else part.pop(old) for old, new in (("spring", "spring"), ("value", "w")) if old in part}


def matrix(of, t, folder):
    """Returns K, and the tables of the problem with nodes instead of dofs."""
    only(of, {"stiffness", "dofs", "coordinates", "free_motions", "storage"})
    need("bed" not in t, "a bed with a matrix")
    K = rows(Path(folder) / of["stiffness"])
    labels = (Path(folder) / of["dofs"]).read_bytes().split() if "dofs" in of else [b"%d" % (i + 1) for i in range(len(K))]
    number = {label: i + 1 for i, label in enumerate(labels)}
    need(len(labels) == len(number) == len(K), f"{of.get('dofs')}: not one label for each row")
    keys = {"support": ["fix", "spring"], "contact": ["surface", "face", "stiffness", "state", "other"], "point": ["value"], "settlement": ["value"], "move": ["value"]}

    def converted(table, key):
        return [as_nodes(dict(part), number, keys[key]) for part in table.get(key, [])]

    def loads(step):
        only(step, {"name", "load", "point", "settlement", "move"})
        whole = vector(Path(folder) / step["load"], len(K)) if "load" in step else {}
        points = [{"node": dof + 1, "w": load} for dof, load in whole.items()]
        return {"name": step.get("name", ""), "point": converted(step, "point") + points} | {key: converted(step, key) for key in ("settlement", "move")}

    steps = {key: [loads(step) for step in t[key]] for key in ("step", "case") if key in t} | {key: t[key] for key in ("combination",) if key in t}
    return K, {"support": converted(t, "support"), "contact": converted(t, "contact")} | steps
