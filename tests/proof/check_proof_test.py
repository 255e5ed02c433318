"""check_proof_test.py CONTCT REFERENCE [all|few]: tests that check_proof.py accepts the proof of every reference problem,
and refuses proofs with faults, and proofs of other problems.

Without `all`, plates of 16 x 16 elements and more are left out, which take most of the time; `few`: a dozen problems.
"""
import contextlib
import copy
import io
import json
import random
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest.mock
from decimal import Decimal
from fractions import Fraction as F
from pathlib import Path

program, reference = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
few = "few" in sys.argv
sys.dont_write_bytecode = True
sys.path[:0] = [str(reference), str(Path(__file__).resolve().parents[1] / "manual")]
import check_proof  # noqa: E402
from problem_file import examples  # noqa: E402

failed = 0


def fail(words):
    global failed
    failed += 1
    print(f"FAILED: {words}")


def proof_of(problem, folder, *options):
    """Returns the parsed proof file of a run, or None if its exit status is not 0 or 3."""
    proof = Path(folder) / "proof.json"
    ended = subprocess.run([program, "run", problem, "--quiet", "--proof", proof, *options], capture_output=True, text=True)
    return json.loads(proof.read_text()) if ended.returncode in (0, 3) else None


def verdict(problem, proof, folder):
    """Returns the exit status and the output of check_proof.py."""
    file = Path(folder) / "checked.json"
    file.write_text(json.dumps(proof))
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = check_proof.main(str(problem), str(file))
    return code, said.getvalue()


def scaled(path, factor):
    """Returns a fault that multiplies the number at `path` of a step by `factor`."""
    def fault(step):
        for key in path[:-1]:
            step = step[key]
        step[path[-1]] *= factor
    return fault


def put(key, value):
    def fault(step):
        step[key] = value(step[key]) if callable(value) else value
    return fault


def swapped(key, i, j):
    def fault(step):
        step[key][i], step[key][j] = step[key][j], step[key][i]
    return fault


def wider(step, share):
    """Sets the bound on deflections to this share of the largest deflection, which is not always a fault."""
    step["error"]["w"] = share * max(map(abs, step["displacement"][::2]))


def unheld(step):
    """Gives a loaded step the form of an unloaded step, with bounds so large that they hold for any number."""
    for key in ("displacement", "state", "u", "closed", "z", "scale", "row_of", "shift", "L"):
        step.pop(key)
    step.update(certified=False, error={kind: None if kind in ("w", "slope", "gap") else 1e300 for kind in step["error"]})


# In step 3 of PB7 the beam is on three stops, of which the middle one has the largest force.
FAULTS = {
    "the state is moved": scaled(["u", 16, 0], 1 + 1e-6),
    "the state has lost what doubles leave over": put("u", lambda u: [[hi * (1 + 2e-16), 0.0] for hi, _ in u]),
    "a displacement is off by 1e-9": scaled(["displacement", 8], 1 + 1e-9),
    "the bound on deflections is smaller": scaled(["error", "w"], 1e-3),
    "the bound on slopes is smaller": scaled(["error", "slope"], 1e-3),
    "the bound on contact forces is smaller": scaled(["error", "force"], 1e-3),
    "the bound on reactions is smaller": scaled(["error", "reaction"], 1e-3),
    "the bound on moments is smaller": scaled(["error", "moment"], 1e-3),
    "the bound on shears is smaller": scaled(["error", "shear"], 1e-3),
    "a bound is negative": scaled(["error", "moment"], -1.0),
    "a bound is missing": lambda step: step["error"].pop("shear"),
    "a closed pair is forgotten": put("closed", [1, 3]),
    "all closed pairs are forgotten": put("closed", []),
    "a pair is taken as closed twice": put("closed", [1, 2, 3, 3]),
    "a pair that there is not is taken as closed": put("closed", [1, 2, 4]),
    "a contact force is off by one part in 1e9": scaled(["force", 1], 1 + 1e-9),
    "a contact force pulls": scaled(["force", 1], -1.0),
    "a pressed pair has no force": scaled(["force", 2], 0.0),
    "a reaction has the other sign": scaled(["reactions", 0], -1.0),
    "a moment is off by 1e-9": scaled(["elements", 19], 1 + 1e-9),
    "the shift has the other sign": scaled(["shift"], -1.0),
    "the scaling is another one": put("scale", lambda s: [k + 1 for k in s]),
    "the scaling is no power of two": put("scale", lambda s: [k + 0.5 for k in s]),
    "rows of L are exchanged": swapped("row_of", 3, 4),
    "two dofs have one row": put("row_of", lambda rows: [rows[1], *rows[1:]]),
    "an entry of L is off": scaled(["L", 9, -1], 1 + 1e-3),
    "L is the unit matrix": put("L", lambda rows: [[0.0] * (len(row) - 1) + [1.0] for row in rows]),
    "L is missing": lambda step: step.pop("L"),
    "a loaded step has the form of an unloaded one": unheld,
    "z is another vector": put("z", lambda z: [[1.0, 0.0] for _ in z]),
    "a displacement is left out": lambda step: step["displacement"].pop(),
    "a reaction is left out": lambda step: step["reactions"].pop(),
    "displacements stand among the forces": lambda step: step["force"].extend(step["displacement"][-5:]) or step["displacement"].__delitem__(slice(-5, None)),
    "a displacement is text": put("displacement", lambda d: ["lorem", *d[1:]]),
    "a displacement is true": put("displacement", lambda d: [False, *d[1:]]),
    "a bound is not a number": put("error", lambda e: e | {"w": float("nan")}),
    "a bound is infinite": put("error", lambda e: e | {"w": float("inf")}),
    "a bound is none": put("error", lambda e: e | {"w": None}),
    "a bound is of an unknown kind": put("error", lambda e: e | {"lorem": 1.0}),
    "certified with bounds of 1e300": put("error", lambda e: dict.fromkeys(e, 1e300)),
    "certified with a bound of 1.001 millionths of the largest deflection": lambda step: wider(step, 1.001e-6),
    "certified is a word": put("certified", "true"),
    "a pressed pair is separated": put("state", ["contact", "separated", "contact"]),
    "a state is another word": put("state", ["contact", "evaporates", "contact"]),
    "a pair is numbered 0": put("closed", [0, 1, 2, 3]),
    "a pair is numbered -1": put("closed", [-1, 1, 2, 3]),
    "pairs are out of order": put("closed", [2, 1, 3]),
    "the step is numbered 7": put("step", 7),
    "an unknown key": put("lorem", 1),
    "the state is missing": lambda step: step.pop("state"),
    "no bounds, and yet a state": put("error", None),
}
# The proof must be refused for another problem: one digit of the problem file is changed.
OTHERS = {"EI": (r"EI( *)= *", "1"), "the load": (r"uniform( *)= *", "1"), "a face": (r"face( *)= *", "1"), "a spring": (r"stiffness( *)= *", "1")}


# Matrices given by their lower triangles, and whether they are semidefinite.
MATRICES = {
    "a free chain": ("1 1 1|2 1 -1|2 2 2|3 2 -1|3 3 1", True),
    "a soft motion": ("1 1 1|2 1 -1|2 2 1.00000000000005", True),
    "an eigenvalue of -1e-11": ("1 1 1|2 1 1.00000000001|2 2 1", False),
    "an eigenvalue of -5e-17": ("1 1 1|2 1 1.0000000000000002|2 2 1.0000000000000002|3 3 1", False),
    "stiffness beside a diagonal of 0": ("1 1 0|2 1 1e-9|2 2 1", False),
    "400 dofs, held": ("1 1 2|" + "|".join(f"{i} {i - 1} -1|{i} {i} 2" for i in range(2, 401)), True),
    "400 dofs, an eigenvalue of -0.1": ("1 1 1.9|" + "|".join(f"{i} {i - 1} -1|{i} {i} 1.9" for i in range(2, 401)), False),
}


def check_semidefinite(folder):
    """Tests which matrices check_proof.py accepts as semidefinite, and that it refuses others."""
    problem = Path(folder) / "matrix.toml"
    problem.write_text("[matrix]\nstiffness = \"K.mtx\"\n[[contact]]\ndofs = [\"1\", \"2\"]\nsurface = \"below\"\nface = 0\nstiffness = 1\n[[step]]\npoint = [ { dofs = [\"1\", \"2\"], value = -1 } ]\n")
    for name, (lower, wanted) in MATRICES.items():
        entries = lower.split("|")
        n = entries[-1].split()[0]
        (Path(folder) / "K.mtx").write_text("\n".join(["%%MatrixMarket matrix coordinate real symmetric", f"{n} {n} {len(entries)}", *entries, ""]))
        if check_proof.semidefinite(check_proof.Problem(tomllib.loads(problem.read_text(), parse_float=Decimal), folder)) is not wanted:
            fail(f"{name}: positive semidefinite is not {wanted}")
        if name == "a free chain":
            chain = Path(folder) / "chain.toml"
            chain.write_text(problem.read_text().replace('"2"', '"3"'))
            proof = proof_of(chain, folder, "--kernels", "corrected")
            with unittest.mock.patch.object(check_proof, "semidefinite", lambda p: False):
                codes = verdict(chain, proof, folder)[0], proof["steps"][0]["closed"]
            if verdict(chain, proof, folder)[0] != 0 or codes != (1, [1, 2]):
                fail("a free chain on two pairs: it is not asked whether the matrix is semidefinite")
    (Path(folder) / "K.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 1\n2 1 1.00000000001\n2 2 1\n3 2 -0.5\n3 3 5\n")
    rounded, declared = problem.read_text() + "[[support]]\ndof = \"3\"\nfix = true\n", Path(folder) / "declared.toml"
    problem.write_text(rounded)
    declared.write_text(rounded.replace("\n[[", "\nfree_motions = 1\n[[", 1))
    proof = proof_of(declared, folder, "--kernels", "corrected")
    false = copy.deepcopy(proof)
    scaled(["error", "reaction"], 1e-3)(false["steps"][0])
    codes = [verdict(declared, proof, folder)[0], verdict(problem, proof, folder)[0], verdict(declared, false, folder)[0]]
    if not proof["steps"][0]["certified"] or codes != [0, 1, 1]:
        fail(f"an indefinite matrix is not certified just where free_motions is given: {codes}")
    (Path(folder) / "K.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1e-9\n2 1 10\n2 2 0.7\n")
    problem.write_text("[matrix]\nstiffness = \"K.mtx\"\n[[support]]\ndof = \"1\"\nfix = true\n[[step]]\npoint = [ { dof = \"2\", value = -0.3 } ]\n")
    proof = proof_of(problem, folder, "--kernels", "corrected")
    p, step = check_proof.Problem(tomllib.loads(problem.read_text(), parse_float=Decimal), folder), proof["steps"][0]
    c = check_proof.bounded(p, *p.loads(p.steps[0])[:2], step)[-1]
    if verdict(problem, proof, folder)[0] != 0 or check_proof.spread_of(p, step, c, 0) < 99 * c[1] or not c[1] > 0:
        fail("the reaction of a fixed dof is bounded by the diagonal of a matrix that is indefinite at this dof")
    print(f"{len(MATRICES)} matrices are semidefinite or not")


def check_reference(folder):
    accepted = proved = certified = contradicted = 0
    files = [file for folder in ("problems", "problems/divergences", "structures", "cookbook") for file in sorted(reference.glob(f"{folder}/*.toml"))]
    if "all" not in sys.argv:
        files = [file for file in files if not re.search("n16|n24", file.name)]
    if few:
        files = files[::5]
    for problem in files:
        for kernel in ("corrected", "fortran"):
            proof = proof_of(problem, folder, "--kernels", kernel)
            if proof is None:  # a mechanism by the 1989 rule
                if kernel == "corrected":
                    fail(f"{problem.name}: no end with {kernel}")
                continue
            proved += sum(step["error"] is not None for step in proof["steps"])
            certified += sum(step["certified"] for step in proof["steps"])
            code, said = verdict(problem, proof, folder)
            if code != 0 and (kernel == "corrected" or code == 1):
                fail(f"{problem.name}, {kernel}: {code}: {said}")
            accepted += code == 0
            contradicted += code == 2
    least = (12, 30, 25, 0) if few else (44, 150, 140, 1)
    if accepted < 2 * len(files) - 5 or any(found < most for found, most in zip((len(files), proved, certified, contradicted), least)):
        fail(f"only {accepted} proofs with {proved} steps, {certified} certified, were accepted, {contradicted} not in all")
    print(f"{accepted} proofs of {len(files)} problems, with {proved} steps, {certified} certified, are accepted")


def check_forms(folder):
    """Tests that check_proof.py reads the examples of problem-file.md, which have every key of its tables."""
    page, texts = (reference / "problem-file.md").read_text(), []
    for file in [*(reference / "structures").iterdir(), *(reference / "structures/calculix").iterdir()]:
        if file.is_file():
            shutil.copy(file, folder)
    problem = Path(folder) / "example.toml"
    for line, text, message in examples(page):
        if message is None and "[calculix]" not in text:
            problem.write_text(text)
            code, said = verdict(problem, proof_of(problem, folder, "--kernels", "corrected"), folder)
            texts.append(text)
            if code != 0:
                fail(f"problem-file.md, line {line}: {code}: {said}")
    page = page[:page.index("## `[calculix]`")] + page[page.index("## `[[support]]`"):]
    keys = set(re.findall(r"`(\w+)`", "".join(re.findall(r"(?m)^\|( `\w+`(?:, `\w+`)*) \|", page)))) - {"calculix"}
    missing = [key for key in sorted(keys) if not re.search(rf"\b{key}\b", "".join(texts))]
    if missing or len(keys) < 40 or len(texts) < 17:
        fail(f"of {len(keys)} keys of the manual {missing} are in none of its {len(texts)} examples")
    print(f"{len(texts)} examples with {len(keys)} keys are read as the program reads them")
    return texts


CANTILEVER = "[beam]\n{}\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
POINT, PART, SUPPORT = "[[step]]\npoint = [ {{ x = {}, w = -1 }} ]\n", "[[step]]\nuniform = [ {{ value = -1, from = {}, to = {} }} ]\n", "[[support]]\nx = {}\nfix = \"w\"\n[[step]]\nuniform = -1\n"
TRAIN = "[[case]]\nname = \"G\"\nuniform = -1\n[[combination]]\nname = \"A\"\nterms = {{ G = 1.35 }}\n[[train]]\nname = \"T\"\naxles = [ {{ at = {}, w = -1 }} ]\nfrom = {}\nto = {}\nby = {}\n"
HAIR, THIRDS, LONG, SIZED = "x = [0, 1e-9, 1e6]", "length = 3.5\nelements = 3", "length = 3.9000000000000004\nelements = 3", "length = 3.5\nelement_size = 1.2"
# Cantilevers, and the exact moments of the clamp in each step; None: program and checker refuse the problem.
PLACES = [
    (HAIR, POINT.format("1.5e-9"), [F("1.5e-9")]), (HAIR, POINT.format("1.0000000000000002e-9"), [F("1.0000000000000002e-9")]),
    (HAIR, PART.format("1e-9", "1.5e-9"), [F("0.625e-18")]), (HAIR, POINT.format("[1e-9, 1.5e-9, 999999.9999999999]"), [F("1000000.0000000024")]),
    (HAIR, SUPPORT.format("1.5e-9"), None), (HAIR, POINT.format("[1e-9, 1.0e-9]"), None), (HAIR, POINT.format("1000000.0000000001"), None),
    (THIRDS, POINT.format("1.16666666666667"), [F(7, 6)]), (THIRDS, POINT.format("1.1666666666666667"), [F(7, 6)]),
    (THIRDS, POINT.format("1.16666666667"), [F(7, 6)]), (THIRDS, POINT.format("1.1666666667"), [F("1.1666666667")]),
    (THIRDS, POINT.format("1.16666666666668"), [F("1.16666666666668")]), (THIRDS, SUPPORT.format("1.1666666667"), None),
    (THIRDS, POINT.format("[1.16666666666667, 1.1666666666666667]"), None), (THIRDS, PART.format("0", "1.16666666667"), [F(49, 72)]),
    ("length = 28\nelements = 3", POINT.format("9.333333333333334"), [F(28, 3)]),  # the double nearest to the node
    ("length = 0.7\nelements = 7", POINT.format("[0.1, 0.3, 0.7]"), [F("1.1")]), ("length = 0.7\nelements = 7", POINT.format("0.30000000000000004"), [F("0.30000000000000004")]),
    (LONG, POINT.format("1.3"), [F("1.3")]), (LONG, SUPPORT.format("1.3"), None), (LONG, PART.format("1.3", "2.6"), [F("2.535")]),  # nodes are rounded to 1.3 and 2.6
    (LONG, POINT.format("[1.3, 1.3000000000000001]"), [F("2.6") + F(4, 3) / 10**16]), (LONG, POINT.format("1.30000000000000"), [F("1.3") + F(4, 3) / 10**16]),
    (SIZED, PART.format("1.16666666667", "3.5"), [(F("12.25") - F(49, 36)) / 2]), (SIZED, POINT.format("[1.2, 1.2000002]"), [F("2.4000002")]),
    (SIZED, POINT.format("[1.23456789012346, 1.2345678901234567]"), None),  # one node
    ("x = [0, 1, 2]", TRAIN.format(0, "0.3", "0.55", "0.1"), [F("2.7"), F("0.3"), F("0.4"), F("0.5")]), ("x = [0, 1, 2]", TRAIN.format(0, 0, "0.3", "0.1"), [F("2.7"), 0, F("0.1"), F("0.2"), F("0.3")]),
    ("x = [0, 1, 2]", TRAIN.format("1e-17", 2, 2, 1), [F("2.7"), 0]), ("x = [0, 1, 2]", TRAIN.format("1e-17", 1, 2, 1), [F("2.7"), 1 + F("1e-17"), 0]),
    ("x = [0, 1000.5, 1001]", TRAIN.format(0, "1000.2", 1001, "0.12345678901234"), [F("1.35") * 1001**2 / 2] + [F("1000.2") + k * F("0.12345678901234") for k in range(7)]),
    (THIRDS, TRAIN.format("1.16666666666667", 0, 0, 1), [F("1.35") * 49 / 8, F("1.16666666666667")]),  # the sum of an axle is not rounded
    ("x = [0, 1, 2]", TRAIN.format(0, 2, -1, 1), None), ("x = [0, 1, 2]", TRAIN.format(0, 0, 2, "1e-9"), None),
    *[("x = [0, 1, 2]", TRAIN.format(0, 0, 2, 1).replace(old, new, 1), None) for old, new in (
        ('"T"', '"A"'), ('name = "A"\n', ""), ("terms = { G = 1.35 }", ""), ("{ G = 1.35 }", "{}"), ("{ G", "{ H"), ('"T"', '" "'), ("w = -1 }", "w = -1, x = 1 }"), ("[[combination]]", "[[step]]"))],
]


def check_places(folder):
    """Tests that the program and check_proof.py refuse the same places and trains, and put the others where their decimals are."""
    problem = Path(folder) / "place.toml"
    for beam, rest, moments in PLACES:
        problem.write_text(CANTILEVER.format(beam) + rest)
        proof = proof_of(problem, folder, "--kernels", "corrected")
        try:
            read = check_proof.Problem(tomllib.loads(problem.read_text(), parse_float=Decimal), folder)
            refusal = [read.loads(step) for step in read.steps] and None
        except Exception as why:
            refusal = check_proof.words_of(why)
        if (proof is None) != (moments is None) or (refusal is None) != (moments is not None):
            fail(f"{problem.read_text()}\nthe program {'refuses' if proof is None else 'accepts'} it; the checker: {refusal}")
        elif proof and (verdict(problem, proof, folder)[0] != 0 or len(proof["steps"]) != len(moments) or any(
                abs(F(step["reactions"][1]) - moment) > min(step["error"]["moment"], 1e-14 * max(abs(moment), 1e-10))
                for step, moment in zip(proof["steps"], moments))):
            fail(f"{problem.read_text()}\n{verdict(problem, proof, folder)}; moments {[step['reactions'][1] for step in proof['steps']]} for {list(map(float, moments))}")
    print(f"{len(PLACES)} places and trains are refused by both, or where their decimals are")


def doctored(text, chance):
    """Returns the problem file with one number, word, text or mark replaced."""
    tokens = list(re.finditer(r'(?P<text>"[^"]*")|(?P<word>[A-Za-z_]\w*)|(?P<number>[-+]?\d[\w.+-]*)|(?P<mark>[][{}=,])', text))
    at = chance.choice(tokens)
    new = ["", at[0] * 2, "0", "1e400", "nan", "true", "[]", '"x"', "-1", "1e-17", "99999999999999999999"]
    if at["number"] or chance.random() < 0.7:
        new = [other[0] for other in tokens if other.lastgroup == at.lastgroup and other[0] != at[0]] or new
    if at["number"]:
        new += 5 * [f"{at[0]}1", f"-{at[0]}", f"1{at[0]}", at[0].replace("1", "2"), at[0].replace(".", ".0"), str(float(at[0]) * (1 + 1e-15))]
    return text[:at.start()] + chance.choice(new) + text[at.end():]


def meaning_of(text, folder):
    p = check_proof.Problem(tomllib.loads(text, parse_float=Decimal), folder)
    return p.K, p.supports, p.others, [(p.loads(step), p.pairs) for step in p.steps]


def agree(proof, other):
    """Returns True if the numbers of two proof files differ by no more than the sums of their bounds."""
    kinds = {"displacement": ("w", "slope"), "force": ("force",), "reactions": ("reaction", "moment"), "elements": ("moment", "shear")}
    return len(proof["steps"]) == len(other["steps"]) and all(
        abs(a - b) <= sum(max(step["error"].get(kind) or 0 for kind in kinds[key]) for step in (s, t))
        for s, t in zip(proof["steps"], other["steps"]) for key in kinds if key in s and t["error"] for a, b in zip(s[key], t[key], strict=True))


def check_doctored(folder, texts, count=2000):
    """Tests that check_proof.py refuses a right proof of a doctored problem, unless its numbers are right for this problem too."""
    problem, chance, refused, same, solved = Path(folder) / "doctored.toml", random.Random(2026), 0, 0, 0
    originals = []
    for text in texts:
        problem.write_text(text := re.sub(r"#.*", "", text))
        originals.append((text, proof_of(problem, folder, "--kernels", "corrected"), meaning_of(text, folder)))
    for i in range(count):
        text, proof, meant = originals[i % len(originals)]
        problem.write_text(now := doctored(text, chance))
        code, said = verdict(problem, proof, folder)
        if code == 1 and "REFUSED: " in said:
            refused += 1
        elif meaning_of(now, folder) == meant:
            same += 1
        elif (other := proof_of(problem, folder, "--kernels", "corrected")) and agree(proof, other):
            solved += 1
        else:
            fail(f"accepted with the proof of another problem: {now}\n{said}")
    if refused < count / 2 or same < count / 50 or solved < (not few):
        fail(f"of {count} doctored problems only {refused} are refused, {same} mean the same, {solved} have the same numbers")
    print(f"{count} problems are doctored: {refused} are refused, {same} mean the same, {solved} have the same numbers")


# Loads inside the elements of a cantilever that load no node.
CANCELLED = ["[[step]]\npoint = [ { x = 0.1, w = 1 }, { x = 0.3, w = -4 }, { x = 0.5, w = 6 }, { x = 0.7, w = -4 }, { x = 0.9, w = 1 } ]\n",
             "[[step]]\ncurvature = [ { value = 1, to = 0.25 }, { value = -1, from = 0.25, to = 0.75 }, { value = 1, from = 0.75 } ]\n",
             "[[case]]\nname = \"a\"\nuniform = -1\n[[case]]\nname = \"b\"\nuniform = [ { value = -2, to = 0.5 }, { value = -2, from = 0.5 } ]\n"
             "[[combination]]\nname = \"c\"\nterms = { a = 1 }\n[[combination]]\nname = \"0\"\nterms = { a = 1, b = -0.5 }\n"]


def check_cancelled(folder):
    problem = Path(folder) / "cancelled.toml"
    for text in CANCELLED:
        problem.write_text('[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = ["w", "theta"]\n' + text)
        proof = proof_of(problem, folder, "--kernels", "corrected")
        code, said = verdict(problem, proof, folder)
        proof["steps"][0]["error"]["w"] = 1.0
        if code != 0 or said.count("; certified") != len(proof["steps"]) or verdict(problem, proof, folder)[0] != 1:
            fail(f"{text}: {code}: {said}")


def check_balanced(folder):
    """Tests that a certified step is not refused if the largest loads so far acted in a step without bounds."""
    problem = Path(folder) / "balanced.toml"
    problem.write_text('[beam]\nx = [0, 6, 12]\nEI = 1e4\n[[contact]]\nnode = 2\nsurface = "below"\nface = 0\nstiffness = 1e5\n'
                       '[[step]]\nuniform = -15\n[[step]]\nmove = [ { node = 2, w = -0.001 } ]\n')
    code, said = verdict(problem, proof_of(problem, folder, "--kernels", "corrected"), folder)
    if code != 2 or "step 2 of 2: 9 numbers are within their bounds; certified; measured by a step without bounds" not in said:
        fail(f"an unloaded step after a balanced one: {code}: {said}")


def check_faults(folder):
    problem = reference / "problems/pb07-three-gap-supports.toml"
    proof = proof_of(problem, folder, "--kernels", "corrected")
    if verdict(problem, proof, folder)[0] != 0 or proof["steps"][2]["closed"] != [1, 2, 3]:
        fail("the proof that is to be doctored is not as expected")
    for name, fault in FAULTS.items():
        doctored = copy.deepcopy(proof)
        fault(doctored["steps"][2])
        code, said = verdict(problem, doctored, folder)
        if code != 1 or not re.search("step 3( of 4: REFUSED|: )|is no number", said):
            fail(f"{name}: {code}: {said}")
    doctored = copy.deepcopy(proof)
    wider(doctored["steps"][2], 0.999e-6)
    if verdict(problem, doctored, folder)[0] != 0:
        fail("a bound of 0.999 millionths of the largest deflection is refused")
    doctored = copy.deepcopy(proof)
    doctored["steps"][2]["L"] = doctored["steps"][0]["L"]
    if verdict(problem, doctored, folder)[0] != 1:
        fail("the factor is that of another state")
    doctored = copy.deepcopy(proof)
    doctored["steps"][1], doctored["steps"][2] = doctored["steps"][2], doctored["steps"][1]
    if verdict(problem, doctored, folder)[0] != 1:
        fail("steps are exchanged")
    for name, steps in (("only the first step", proof["steps"][:1]), ("no step", []), ("a step twice", [*proof["steps"], proof["steps"][3]])):
        if verdict(problem, proof | {"steps": steps}, folder)[0] != 1:
            fail(name)
    without = proof["steps"][:3] + [{"step": 4, "certified": False, "error": None, "because": "lorem"}]
    if verdict(problem, proof | {"steps": without}, folder)[0] != 2:
        fail("a step without bounds counts as proved")
    doctored = copy.deepcopy(proof)  # pair 3 is listed twice, and the factor has its spring twice
    twice = Path(folder) / "twice.toml"
    contact = "\n[[contact]]\nnode = 13\nsurface = \"below\"\nface = -0.006\nstiffness = 1.0e5\n"
    twice.write_text(problem.read_text().replace("\n[[step]]", contact + "\n[[step]]", 1))
    doctored["steps"][2].update({key: proof_of(twice, folder, "--kernels", "corrected")["steps"][2][key] for key in ("L", "shift", "scale")})
    doctored["steps"][2].update(closed=[1, 2, 3, 0], error={kind: 1e6 * bound for kind, bound in proof["steps"][2]["error"].items()})
    if verdict(problem, doctored, folder)[0] != 1:
        fail("a pair is taken as closed under two numbers")
    problem_that_opens = reference / "problems/pb01-cantilever-tip-stop.toml"
    opened = proof_of(problem_that_opens, folder, "--kernels", "corrected")
    unloaded = Path(folder) / "unloaded.toml"  # an unproved earlier step must not increase the allowed error
    unloaded.write_text("[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[step]]\nuniform = -1\n[[step]]\nuniform = 0\n")
    inflated = proof_of(unloaded, folder, "--kernels", "corrected")
    inflated["steps"][0].update(certified=False, displacement=[1e200] * 4, error=dict.fromkeys(inflated["steps"][0]["error"], 1e300))
    codes = [verdict(unloaded, inflated, folder)[0]]
    inflated["steps"][1]["error"]["w"] = 1e100
    if [*codes, verdict(unloaded, inflated, folder)[0]] != [0, 1]:
        fail("an unloaded state is measured by a deflection that is not certified")
    opened["steps"][3]["closed"] = [1]
    if verdict(problem_that_opens, opened, folder)[0] != 1:
        fail("an open pair is taken as closed")
    opened["steps"][3].update(closed=[], state=["contact"])
    if verdict(problem_that_opens, opened, folder)[0] != 1:
        fail("an open pair is said to be in contact")
    opened["steps"][3]["certified"], opened["steps"][3]["error"]["gap"] = False, 1.0
    if verdict(problem_that_opens, opened, folder)[0] != 2:
        fail("a state that the bounds contradict counts as shown")
    for name, (pattern, digit) in OTHERS.items():
        other = Path(folder) / "other.toml"
        text = problem.read_text()
        changed = re.sub(pattern + r"(-?[0-9.]*[0-9])", lambda m: m.group(0) + ("" if "." in m.group(2) else ".") + "000001" + digit, text, count=1)
        other.write_text(changed)
        code, said = verdict(other, proof, folder)
        if changed == text or code != 1:
            fail(f"the proof of a problem in which {name} is another: {code}: {said}")
    print(f"{len(FAULTS) + 11 + len(OTHERS)} doctored proofs were tried")


with tempfile.TemporaryDirectory() as scratch:
    check_reference(scratch)
    check_faults(scratch)
    check_semidefinite(scratch)
    check_places(scratch)
    check_doctored(scratch, check_forms(scratch), 200 if few else 2000)
    check_cancelled(scratch)
    check_balanced(scratch)
print("FAILED" if failed else "passed")
sys.exit(1 if failed else 0)
