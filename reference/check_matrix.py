"""A structure given by its matrix, in fractions, for check_proof.py: each dof becomes a node whose only dof is w."""
from fractions import Fraction as F
from pathlib import Path

from check_beam import listed, meant


def entries(file):
    """The words of a Matrix Market file's header, and its numbers line by line."""
    lines = file.read_text().splitlines()
    numbers = [line.split() for line in lines[1:] if line.strip() and not line.startswith("%")]
    return lines[0].lower().split(), numbers[1:]


def rows(file, n):
    """K by rows, from its lower triangle."""
    K = [{i: F(0)} for i in range(n)]
    for i, j, k in entries(file)[1]:
        K[int(i) - 1][int(j) - 1] = K[int(j) - 1][int(i) - 1] = meant(k)
    return K


def vector(file):
    """{dof: its load}."""
    header, numbers = entries(file)
    if "coordinate" in header:
        return {int(i) - 1: meant(k) for i, _, k in numbers}
    return {i: meant(k) for i, (k,) in enumerate(numbers)}


def as_nodes(part, number):
    """The table with nodes for dofs, fix and springs of w, and w for a value."""
    part = dict(part, nodes=[number[str(label)] for label in listed(part.get("dofs", part.get("dof")))])
    if "value" in part:
        part["w"] = part["value"]
    if "spring" in part:
        part["spring"] = {"w": part["spring"]}
    if "fix" in part:
        part["fix"] = ["w"] if part["fix"] else []
    return part


def matrix(of, t, folder):
    """K, and the problem in terms of nodes."""
    n = int(next(line for line in (Path(folder) / of["stiffness"]).read_text().splitlines() if line[0] != "%").split()[0])
    labels = (Path(folder) / of["dofs"]).read_text().split() if "dofs" in of else [str(i + 1) for i in range(n)]
    number = {label: i + 1 for i, label in enumerate(labels)}
    t = {key: [as_nodes(part, number) for part in t.get(key, [])] for key in ("support", "contact")} | {"step": t["step"]}
    for i, step in enumerate(t["step"]):
        whole = vector(Path(folder) / step["load"]) if "load" in step else {}
        t["step"][i] = {key: [as_nodes(part, number) for part in step.get(key, [])] for key in ("point", "settlement")}
        t["step"][i]["point"] += [{"nodes": [dof + 1], "w": load} for dof, load in whole.items()]
    return rows(Path(folder) / of["stiffness"], n), t
