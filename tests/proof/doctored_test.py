"""doctored_test.py CONTCT REFERENCE COUNT [SEED]: of COUNT random changes of true proofs, the checker accepts none that makes a proof false.

What a proof claims is compared with exact numbers of `contct exact`. A change may leave a proof true: a larger bound, other
evidence. Whether the checker accepts that is counted, and not judged.
"""
import copy
import json
import random
import subprocess
import sys
import tempfile
import tomllib
from fractions import Fraction as F
from math import isfinite
from pathlib import Path

from proofs import check_proof, end, fail, program, proof_of, verdict

K = "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 1\n2 1 -1\n2 2 2\n3 2 -1\n3 3 1\n"
PAIR = "\n[[contact]]\n{} = {}\nsurface = \"{}\"\nface = {}\nstiffness = {}"
PROBLEMS = {
    "two steps": "[beam]\nx = [0, 1, 2, 4]\nEI = 1e3\n[[support]]\nnodes = [1, 4]\nfix = \"w\"" + PAIR.format("nodes", [2, 3], "below", -0.001, 1e5)
    + "\n[[step]]\nuniform = -1\n[[step]]\nuniform = -9\npoint = [ { node = 2, w = 4 } ]\n",
    "settling": "[beam]\nx = [0, 1, 2]\nEI = 1e3\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[support]]\nnode = 3\nspring = { w = 100 }" + PAIR.format("node", 2, "above", 0.001, 1e4)
    + "\n[[step]]\nsettlement = [ { node = 1, w = 0.01 } ]\n[[step]]\npoint = [ { node = 3, w = 0.5, theta = 1 } ]\n",
    "free": "[beam]\nlength = 2\nelements = 2\nEI = 10" + PAIR.format("nodes", [1, 3], "below", 0, 20) + "\n[[step]]\nuniform = -1\n[[step]]\nuniform = 0\n",
    "plate": "[plate]\nsize = [1, 1]\nelements = [1, 1]\nD = 1\nnu = 0.3\n[[support]]\nnode = 1\nfix = [\"w\", \"wx\", \"wy\"]\n[[bed]]\nmodulus = 10\nface = -0.01\n[[step]]\nuniform = -1\n",
    "matrix": "[matrix]\nstiffness = \"K.mtx\"" + PAIR.format("dofs", '["1", "3"]', "below", 0, 2) + "\n[[step]]\npoint = [ { dof = \"2\", value = -3 } ]\n",
    "in 32 digits": "[beam]\nx = [0, 0.008, 7.008, 7.00802, 7.02802, 12.02802]\nEI = 92\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]" + PAIR.format("node", 2, "below", 0, 1e5)
    + "\n[[step]]\npoint = [ { node = 2, w = -94 } ]\n",
}
WORDS = ["", "lorem", "contact", "separated", "Contact", "make", "w", "slope", "force", "reaction", "moment", "shear", "true", "1.0", "NaN", "L", "L_low", "shares", "because"]
VALUES = [None, True, False, 0, 1, -1, 0.0, -0.0, 1e-300, -1e-300, 1e300, -1e300, 5e-324, 10**30, 0.5, float("nan"), float("inf"), [], {}, [0.0], [0.0, 0.0], {"w": 0.0}]


class Truth:
    """What is true of a problem at the end of each of its steps."""

    def __init__(self, file, folder):
        exact = Path(folder) / "exact.json"
        subprocess.run([program, "exact", file, "--quiet", "--json", exact], capture_output=True, check=True)
        self.ends = json.loads(exact.read_text())["steps"]
        with open(file, "rb") as problem:
            self.problem = check_proof.Problem(tomllib.load(problem, parse_float=F), folder)
        self.steps = [self.of_step(*both) for both in zip(self.problem.steps, self.ends)]

    def of_step(self, step, at_end):
        """Of each list of the file its kinds and true numbers, and the true depths of pairs."""
        p, (_, _, own) = self.problem, self.problem.loads(step)
        u, per = [F(x) for x in at_end["displacement"]], len(self.problem.names)
        elements = [v[:2] for (e, dofs, _), work in zip(p.elements, own) for v in e.values([u[dof] for dof in dofs], work)]
        lists = {"displacement": [("slope" if dof % per else "w", x) for dof, x in enumerate(u)],
                 "force": [("force", F(pair["force"])) for pair in at_end["pairs"]],
                 "reactions": [("moment" if dof % per else "reaction", F(r["value"])) for (dof, _), r in zip(p.supports, at_end["reactions"], strict=True)],
                 "elements": elements}
        return lists, [n * (u[dof] - face) for dof, n, face, _ in p.pairs], self.sizes(p.loads(step), lists)

    def sizes(self, loads, lists):
        """Of each kind of number. None where nothing acts: any earlier size may count then."""
        f, settled, _ = loads
        if not any(f) and not any(settled.values()):
            return None
        of = {kind: max([abs(x) for all in lists.values() for k, x in all if k == kind], default=F(0)) for kind in ("w", "slope", "force", "reaction", "shear", "moment")}
        forces = max(*map(abs, f[::len(self.problem.names)]), of["force"], of["reaction"], of["shear"])
        return {"w": of["w"], "slope": max(of["slope"], of["w"] / (self.problem.span or 1)), "force": forces, "reaction": forces, "shear": forces,
                "moment": max([of["moment"], forces * self.problem.span, *map(abs, f)])}

    @staticmethod
    def gaps(s, deep, problem):
        """The gap of each pair as the file has it, and the true one."""
        told = [0.0 if state == "contact" else n * (float(face) - s["displacement"][dof])
                for (dof, n, face, _), state in zip(problem.pairs, s["state"], strict=True)]
        return [(F(x), max(-d, F(0))) for x, d in zip(told, deep, strict=True)]

    def why_false(self, proof):
        """What is false of a proof, or no proof's form; None where it is true."""
        if type(proof) is not dict or set(proof) != {"format", "steps"} or proof["format"] != "contct-proof-2" or type(proof["steps"]) is not list:
            return "format"
        if len(proof["steps"]) != len(self.steps):
            return "steps are missing, or too many"
        return next((why for i, s in enumerate(proof["steps"]) if (why := self.why_false_step(i, s))), None)

    def why_false_step(self, i, s):
        try:
            return self.why_false_keys(i, s) or self.why_false_numbers(i, s) or self.why_false_evidence(i, s)
        except (TypeError, AttributeError, KeyError, ValueError, OverflowError, IndexError) as why:
            return f"types: {why!r}"

    def why_false_keys(self, i, s):
        if type(s["step"]) is not int or s["step"] != i + 1 or type(s["certified"]) is not bool:
            return "step or certified"
        held = {"displacement", "state", "u", "closed", "z", "scale", "row_of", "shift", "L"}
        keys = {"step", "certified", "error", "force", "reactions", "elements"}
        if s["error"] is None or set(s) not in (keys, keys | held, keys | held | {"L_low"}):
            return "keys"
        kinds = {kind for all in self.steps[i][0].values() for kind, _ in all} | ({"gap"} if "state" in s and s["state"] else set())
        if not kinds <= set(s["error"]) <= set(self.problem.kinds) or any(s["error"][kind] is not None for kind in set(s["error"]) - kinds):
            return "kinds of bounds"
        return None

    def why_false_numbers(self, i, s):
        lists, deep, sizes = self.steps[i]
        for key, true in lists.items():
            if key == "displacement" and key not in s:
                if s["error"]["w"] is not None or s["error"]["slope"] is not None:
                    return "bounds without displacements"
                continue
            if len(s[key]) != len(true) or any(type(x) not in (int, float) for x in s[key]):
                return key
            if any(type(s["error"][kind]) not in (int, float) or not abs(F(x) - value) <= F(s["error"][kind]) for x, (kind, value) in zip(s[key], true)):
                return f"a number of {key}"
        gaps = self.gaps(s, deep, self.problem) if "state" in s else []
        if any(state not in ("contact", "separated") for state in s.get("state", [])):
            return "state"
        if any(not abs(told - true) <= F(s["error"]["gap"]) for told, true in gaps):
            return "a gap"
        sizes = sizes and {**sizes, "gap": max([sizes["w"], *(true for _, true in gaps)])}
        if s["certified"] and any(sizes and bound and F(bound) > F(1.001e-6) * sizes[kind] for kind, bound in s["error"].items()):
            return "certified"
        return None

    def why_false_evidence(self, i, s):
        """It may be any, but is of doubles, and of numbers that there are."""
        if "L" not in s:
            return None
        n, deep, rows = self.problem.n, self.steps[i][1], s["L"] + s.get("L_low", [])
        if any(type(c) is not int or not 1 <= c <= len(deep) or deep[c - 1] <= 0 for c in s["closed"]) or s["closed"] != sorted(set(s["closed"])):
            return "closed"
        if [len(s["u"]), len(s["scale"]), len(s["L"]), len(s["z"]) or n] != 4 * [n] or sorted(s["row_of"]) != list(range(n)) or any(map(len, s["u"] + s["z"])) and {len(x) for x in s["u"] + s["z"]} != {2}:
            return "lengths"
        numbers = [s["shift"], *(x for row in rows + s["u"] + s["z"] for x in row)]
        if any(type(x) not in (int, float) for x in numbers) or any(type(x) is not int for x in s["scale"] + s["row_of"]):
            return "evidence of another type"
        return None


def places(value, path=()):
    """Every place in a value, as (container, key)."""
    entries = value.items() if type(value) is dict else enumerate(value) if type(value) is list else []
    return [place for key, inner in entries for place in [(value, key), *places(inner)]]


def nudged(x):
    """Another number, mostly a near one."""
    if type(x) is bool:
        return not x
    if type(x) is int:
        return x + random.choice([-2, -1, 1, 1, 2, 7, 0.0])
    if not isfinite(x):
        return 0.0
    return random.choice([-x, x * (1 + random.choice([-1, 1]) * 10.0**-random.randrange(16)), x * 2.0**random.randrange(-60, 60), x + random.choice([-1, 1]) * 10.0**-random.randrange(20), 0.0, repr(x), bool(x), int(x)])


def change(proof, others):
    """Changes a proof in one place. True if there is something to change."""
    where = places(proof)
    evidence = [place for place in where if place[1] not in ("L", "L_low", "u", "z") and type(place[0]) is not list]  # there are few
    container, key = random.choice(where if random.random() < 0.5 else evidence)
    value, what = container[key], random.choice("nnnnnnvvwdsrxoa")
    if what == "n" and type(value) in (int, float, bool):
        container[key] = nudged(value)
    elif what == "n" and type(value) is list and value:
        at = random.randrange(len(value))
        value[at] = nudged(value[at]) if type(value[at]) in (int, float, bool) else random.choice(WORDS)
    elif what == "v":
        container[key] = copy.deepcopy(random.choice(VALUES))
    elif what == "w":
        container[key] = random.choice(WORDS)
    elif what == "d":
        del container[key]
    elif what == "s" and type(container) is list:
        other = random.randrange(len(container))
        container[key], container[other] = container[other], value
    elif what == "r" and type(container) is dict:
        container[random.choice(WORDS)] = container.pop(key) if random.random() < 0.5 else value
    elif what == "x" and type(container) is list:
        container.insert(random.randrange(len(container) + 1), copy.deepcopy(value))
    elif what in "xo" and type(value) is list and type(container) is dict:
        key_of_other, other = random.choice([(k, v) for k, v in container.items() if type(v) is list])
        moved = random.randrange(len(value) + 1)
        container[key], container[key_of_other] = (value[:moved], other + value[moved:]) if what == "x" else (other, value)
    elif what in "oa":
        alike = [c[k] for other in others for c, k in places(other) if k == key and type(c[k]) is type(value)]
        container[key] = copy.deepcopy(random.choice(alike or WORDS))
    else:
        return False
    return True


def doctored(proof, others):
    """A proof that differs from `proof` in one to three places."""
    other = copy.deepcopy(proof)
    for _ in range(random.choice([1, 1, 1, 2, 3])):
        while not change(other, others):
            pass
        if not places(other):
            break
    return other


def with_a_key_twice(proof):
    """As text, with another value before the first that a key has."""
    key = random.choice([key for _, key in places(proof) if type(key) is str])
    return json.dumps(proof).replace(f'"{key}": ', f'"{key}": {json.dumps(random.choice(VALUES + WORDS))}, "{key}": ', 1)


with tempfile.TemporaryDirectory() as scratch:
    random.seed(int(sys.argv[4]) if len(sys.argv) > 4 else 38)
    (Path(scratch) / "K.mtx").write_text(K)
    bases, accepted, refused = [], {}, {}
    for name, text in PROBLEMS.items():
        file = Path(scratch) / f"{name}.toml"
        file.write_text(text)
        bases.append((name, file, proof_of(file, scratch, "--kernels", "corrected"), Truth(file, scratch)))
        if verdict(file, bases[-1][2], scratch)[0] != 0 or bases[-1][3].why_false(bases[-1][2]):
            fail(f"{name}: the true proof: {verdict(file, bases[-1][2], scratch)} {bases[-1][3].why_false(bases[-1][2])}")
    for number in range(int(sys.argv[3])):
        name, file, proof, truth = random.choice(bases)
        twice = random.random() < 0.02
        other = with_a_key_twice(proof) if twice else doctored(proof, [base[2] for base in bases])
        why = "a key stands twice" if twice else truth.why_false(other)
        code, said = verdict(file, other, scratch)
        counted = accepted if code == 0 else refused
        counted[why is None] = counted.get(why is None, 0) + 1
        if code == 0 and why is not None:
            fail(f"{name}, doctored proof {number + 1}: accepted, but false: {why}\n{json.dumps(other)}\n{said}")
    print(f"doctored proofs: {refused.get(False, 0)} false ones are refused, {accepted.get(False, 0)} accepted; of true ones {accepted.get(True, 0)} are accepted, {refused.get(True, 0)} refused")
    if refused.get(False, 0) < 0.6 * int(sys.argv[3]) or accepted.get(True, 0) < 0.02 * int(sys.argv[3]):
        fail("too few of a kind")
end()
