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
import sys
import tempfile
import tomllib
import unittest.mock
from decimal import Decimal
from fractions import Fraction as F
from pathlib import Path

program, reference = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
few = "few" in sys.argv
sys.path[:0] = [str(reference), *(str(Path(__file__).resolve().parents[1] / folder) for folder in ("manual", "support"))]
from testing import Checks, run  # noqa: E402
import check_proof  # noqa: E402
from problem_file import examples  # noqa: E402

check = Checks()


def proof_of(problem, kernel="corrected"):
    """Returns the parsed proof file of a run, or None if its exit status is not 0 or 3."""
    ended = run(program, "run", problem, "--quiet", "--proof", folder / "proof.json", "--kernels", kernel)
    return json.loads((folder / "proof.json").read_text()) if ended.returncode in (0, 3) else None


def verdict(problem, proof):
    """Returns the exit status and the output of check_proof.py."""
    (folder / "checked.json").write_text(json.dumps(proof))
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = check_proof.main(str(problem), str(folder / "checked.json"))
    return code, said.getvalue()


def expect(wanted, what, problem, proof, words=""):
    """Checks the exit status of check_proof.py, and words in its output."""
    code, said = verdict(problem, proof)
    return check(code == wanted and re.search(words, said), f"{what}: found {code}: {said}; allowed: {wanted}")


def file_of(name, text):
    (folder / name).write_text(text)
    return folder / name


read = lambda text: check_proof.Problem(tomllib.loads(text, parse_float=Decimal), folder)


def scaled(path, factor):
    """Returns a fault that multiplies the number at `path` of a step by `factor`."""
    def fault(step):
        for key in path[:-1]:
            step = step[key]
        step[path[-1]] *= factor
    return fault


def put(key, value):
    return lambda step: step.update({key: value(step[key]) if callable(value) else value})


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
    **{f"the bound on {kind} is smaller": scaled(["error", kind], 1e-3) for kind in ("w", "slope", "force", "reaction", "moment", "shear")},
    "a bound is negative": scaled(["error", "moment"], -1.0),
    "a bound is missing": lambda step: step["error"].pop("shear"),
    **{f"{closed} are taken as closed": put("closed", closed) for closed in ([1, 3], [], [1, 2, 3, 3], [1, 2, 4], [0, 1, 2, 3], [-1, 1, 2, 3], [2, 1, 3])},
    "a contact force is off by one part in 1e9": scaled(["force", 1], 1 + 1e-9),
    "a contact force pulls": scaled(["force", 1], -1.0),
    "a pressed pair has no force": scaled(["force", 2], 0.0),
    "a reaction has the other sign": scaled(["reactions", 0], -1.0),
    "a moment is off by 1e-9": scaled(["elements", 19], 1 + 1e-9),
    "the shift has the other sign": scaled(["shift"], -1.0),
    "the scaling is another one": put("scale", lambda s: [k + 1 for k in s]),
    "the scaling is no power of two": put("scale", lambda s: [k + 0.5 for k in s]),
    "rows of L are exchanged": put("row_of", lambda rows: [*rows[:3], rows[4], rows[3], *rows[5:]]),
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
    **{f"the bounds are {bound}": put("error", lambda e, bound=bound: e | bound) for bound in ({"w": float("nan")}, {"w": float("inf")}, {"w": None}, {"lorem": 1.0})},
    "certified with bounds of 1e300": put("error", lambda e: dict.fromkeys(e, 1e300)),
    "certified with a bound of 1.001 millionths of the largest deflection": lambda step: wider(step, 1.001e-6),
    "certified is a word": put("certified", "true"),
    "a pressed pair is separated": put("state", ["contact", "separated", "contact"]),
    "a state is another word": put("state", ["contact", "evaporates", "contact"]),
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


def write_matrix(lower):
    entries = lower.split("|")
    n = entries[-1].split()[0]
    file_of("K.mtx", "\n".join(["%%MatrixMarket matrix coordinate real symmetric", f"{n} {n} {len(entries)}", *entries, ""]))


OF_MATRIX = "[matrix]\nstiffness = \"K.mtx\"\n"
BETWEEN = OF_MATRIX + "[[contact]]\ndofs = [\"1\", \"2\"]\nsurface = \"below\"\nface = 0\nstiffness = 1\n[[step]]\npoint = [ { dofs = [\"1\", \"2\"], value = -1 } ]\n"


def check_semidefinite():
    """Tests which matrices check_proof.py accepts as semidefinite, and that it refuses others."""
    for name, (lower, wanted) in MATRICES.items():
        write_matrix(lower)
        check(check_proof.semidefinite(read(BETWEEN)) is wanted, f"{name}: positive semidefinite is not {wanted}")
    write_matrix(MATRICES["a free chain"][0])
    chain = file_of("chain.toml", BETWEEN.replace('"2"', '"3"'))
    proof = proof_of(chain)
    expect(0, "a free chain on two pairs", chain, proof)
    with unittest.mock.patch.object(check_proof, "semidefinite", lambda p: False):
        expect(1, "a free chain on two pairs: it is not asked whether the matrix is semidefinite", chain, proof)
    check(proof["steps"][0]["closed"] == [1, 2], "both pairs of a free chain are closed")

    write_matrix("1 1 1|2 1 1.00000000001|2 2 1|3 2 -0.5|3 3 5")
    text = BETWEEN + "[[support]]\ndof = \"3\"\nfix = true\n"
    plain, declared = file_of("plain.toml", text), file_of("declared.toml", text.replace("\n[[", "\nfree_motions = 1\n[[", 1))
    proof = proof_of(declared)
    check(proof["steps"][0]["certified"], "an indefinite matrix is certified where free_motions is given")
    expect(0, "an indefinite matrix with free_motions", declared, proof)
    expect(1, "an indefinite matrix without free_motions", plain, proof)
    scaled(["error", "reaction"], 1e-3)(proof["steps"][0])
    expect(1, "a smaller bound on reactions", declared, proof)

    write_matrix("1 1 1e-9|2 1 10|2 2 0.7")
    text = OF_MATRIX + "[[support]]\ndof = \"1\"\nfix = true\n[[step]]\npoint = [ { dof = \"2\", value = -0.3 } ]\n"
    proof, p = proof_of(file_of("fixed.toml", text)), read(text)
    c = check_proof.bounded(p, *p.loads(p.steps[0])[:2], proof["steps"][0])[-1]
    expect(0, "a fixed dof of an indefinite matrix", folder / "fixed.toml", proof)
    check(check_proof.spread_of(p, proof["steps"][0], c, 0) >= 99 * c[1] > 0, "the reaction of a fixed dof is bounded by the diagonal of a matrix that is indefinite at this dof")


def check_reference():
    counted, files = check.counted, [file for part in ("problems", "problems/divergences", "structures", "cookbook") for file in sorted(reference.glob(f"{part}/*.toml"))]
    if "all" not in sys.argv:
        files = [file for file in files if not re.search("n16|n24", file.name)]
    if few:
        files = files[::5]
    for problem in files:
        for kernel in ("corrected", "fortran"):
            proof = proof_of(problem, kernel)
            if proof is None:  # a mechanism by the 1989 rule
                check(kernel != "corrected", f"{problem.name}: no end with {kernel}")
                continue
            code, said = verdict(problem, proof)
            check(code == 0 or (kernel != "corrected" and code != 1), f"{problem.name}, {kernel}: {code}: {said}")
            counted.update({"accepted": code == 0, "contradicted": code == 2, "proved steps": sum(step["error"] is not None for step in proof["steps"]),
                            "certified steps": sum(step["certified"] for step in proof["steps"])})
    check(len(files) >= (12 if few else 44) and counted["accepted"] >= 2 * len(files) - 5, f"{len(files)} problems, {counted['accepted']} accepted proofs")


def check_forms():
    """Tests that check_proof.py reads the examples of problem-file.md, which have every key of its tables."""
    page, texts = (reference / "problem-file.md").read_text(), []
    for file in [*(reference / "structures").iterdir(), *(reference / "structures/calculix").iterdir()]:
        if file.is_file():
            shutil.copy(file, folder)
    for line, text, message in examples(page):
        if message is None and "[calculix]" not in text:
            problem = file_of("example.toml", text)
            expect(0, f"problem-file.md, line {line}", problem, proof_of(problem))
            texts.append(text)
    page = page[:page.index("## `[calculix]`")] + page[page.index("## `[[support]]`"):]
    keys = set(re.findall(r"`(\w+)`", "".join(re.findall(r"(?m)^\|( `\w+`(?:, `\w+`)*) \|", page)))) - {"calculix"}
    missing = [key for key in sorted(keys) if not re.search(rf"\b{key}\b", "".join(texts))]
    check(not missing and len(keys) >= 40 and len(texts) >= 17, f"of {len(keys)} keys of the manual {missing} are in none of its {len(texts)} examples")
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


def check_places():
    """Tests that the program and check_proof.py refuse the same places and trains, and put the others where their decimals are."""
    for beam, rest, moments in PLACES:
        text = CANTILEVER.format(beam) + rest
        problem = file_of("place.toml", text)
        proof = proof_of(problem)
        try:
            p = read(text)
            refusal = [p.loads(step) for step in p.steps] and None
        except Exception as why:
            refusal = check_proof.words_of(why)
        if check((proof is None) == (moments is None) == (refusal is not None), f"{text}\nthe program {'refuses' if proof is None else 'accepts'} it; the checker: {refusal}") and proof:
            expect(0, text, problem, proof)
            found = [F(step["reactions"][1]) for step in proof["steps"]]
            check(len(found) == len(moments) and all(abs(a - b) <= min(step["error"]["moment"], 1e-14 * max(abs(b), 1e-10)) for a, b, step in zip(found, moments, proof["steps"])),
                  f"{text}\nmoments {list(map(float, found))} for {list(map(float, moments))}")


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


def meaning_of(text):
    p = read(text)
    return p.K, p.supports, p.others, [(p.loads(step), p.pairs, p.held) for step in p.steps]


def agree(proof, other):
    """Returns True if the numbers of two proof files differ by no more than the sums of their bounds."""
    kinds = {"displacement": ("w", "slope"), "force": ("force",), "reactions": ("reaction", "moment"), "elements": ("moment", "shear")}
    return len(proof["steps"]) == len(other["steps"]) and all(
        abs(a - b) <= sum(max(step["error"].get(kind) or 0 for kind in kinds[key]) for step in (s, t))
        for s, t in zip(proof["steps"], other["steps"]) for key in kinds if key in s and t["error"] for a, b in zip(s[key], t[key], strict=True))


def check_doctored(texts, count, alike, same):
    """Tests that check_proof.py refuses a right proof of a doctored problem, unless its numbers are right for this problem too.

    `alike`: the least number of doctored problems that mean the same; `same`: of those that have the same numbers.
    """
    chance, originals, ends = random.Random(2026), [], dict.fromkeys(("refused", "mean the same", "have the same numbers"), 0)
    for text in (re.sub(r"#.*", "", text) for text in texts):
        originals.append((text, proof_of(file_of("doctored.toml", text)), meaning_of(text)))
    for i in range(count):
        text, proof, meant = originals[i % len(originals)]
        problem = file_of("doctored.toml", now := doctored(text, chance))
        code, said = verdict(problem, proof)
        if code == 1 and "REFUSED: " in said:
            ends["refused"] += 1
        elif meaning_of(now) == meant:
            ends["mean the same"] += 1
        elif check((other := proof_of(problem)) and agree(proof, other), f"accepted with the proof of another problem: {now}\n{said}"):
            ends["have the same numbers"] += 1
    check(ends["refused"] >= count / 2 and ends["mean the same"] >= alike and ends["have the same numbers"] >= same, f"of {count} doctored problems: {ends}")
    print(f"{count} problems are doctored: {ends}")


def sheared_beams(count):
    """Returns random beams with shear flexibility: by GA or by a section, some with a hinge, loaded inside elements."""
    chance, texts = random.Random(7), []
    for _ in range(count):
        x = [0.0]
        for _ in range(chance.randint(3, 5)):
            x.append(round(x[-1] + chance.choice((0.3, 0.5, 0.7, 1.1)), 2))
        at = lambda share: round(share * x[-1], 4)
        stiffness = chance.choice((f"EI = {chance.choice((10.0, 333.3))}\nGA = {chance.choice((0.01, 5.0, 1e3, 1e7))}",
                                   f"section = {{ E = 3.5e4, I = 0.002, G = {chance.choice((80.0, 1e4))}, As = 0.9 }}"))
        clamp = chance.choice(("[[support]]\nx = 0\nfix = \"w\"\n", f'[[hinge]]\nnode = {len(x) - 2}\n[[support]]\nx = 0\nfix = ["w", "theta"]\n'))
        step = f"[[step]]\nuniform = [ {{ value = -{chance.choice((1.5, 3.0))}, from = {at(0.3)}, to = {at(0.8)} }} ]\npoint = [ {{ x = {at(0.37)}, w = -1.0 }}, {{ x = {at(0.61)}, theta = 0.7 }} ]\n"
        bent = chance.choice(("", f"curvature = [ {{ value = 0.01, from = 0.1, to = {at(0.9)} }} ]\n"))
        texts.append(f"[beam]\nx = {x}\n{stiffness}\n{clamp}[[support]]\nx = {x[-1]}\nfix = \"w\"\n[[contact]]\nnode = 2\nsurface = \"below\"\nface = -{chance.choice((0.01, 0.2))}\n"
                     f"stiffness = {chance.choice((5.0, 1e4))}\n{step}{bent}")
    return texts


def hinged_beams(count):
    """Returns random beams with a semi-rigid hinge, some with shear flexibility."""
    chance, texts = random.Random(11), []
    for text in sheared_beams(count):
        text = re.sub("GA = .*\n", "", text) if chance.random() < 0.6 else text
        hinge = f"[[hinge]]\nstiffness = {chance.choice((1e-6, 0.4, 12.5, 700.0, 1e6, 1e30))}\n"
        texts.append(text.replace("[[hinge]]\n", hinge) if "[[hinge]]" in text else f"{text}{hinge}node = 2\n")
    return texts


def bedded(count):
    """Returns random beams with beds from place to place, which may overlap and be in pieces, and plates with beds on rectangles."""
    chance, texts = random.Random(13), []
    for i in range(count):
        ends = lambda: sorted(chance.sample([0.2, 0.5, 0.77, 1.0, 1.9, 2.5, 3.3, 3.9], 2))
        a, b = ends()
        pieces = f"[ {{ to = {(a + b) / 2:.3f}, value = 9 }}, {{ to = {b}, value = 31.5 }} ]"
        face = chance.choice(("0", "-0.01", "{ polynomial = [ 0, -0.002, 0.0003 ] }"))
        bed = f"[[bed]]\nfrom = {a}\nto = {b}\nmodulus = {chance.choice((pieces, '20'))}\nface = {face}\n"
        mesh = chance.choice(("elements = 8", "elements = 13", "element_size = 0.7"))
        c, d = ends()
        held = chance.choice(("spring = { w = 2 }", "fix = \"w\""))
        settles = f"settlement = [ {{ x = 0, w = -0.02 }} ]\nmove = [ {{ x = 0, w = {chance.choice((-0.004, 0.01))} }} ]\n" if "fix" in held else ""
        texts.append(f"[beam]\nlength = 4\n{mesh}\nEI = 12\n{bed}[[bed]]\nmodulus = 15\nface = 0\nto = {b}\n[[support]]\nx = [0, 4]\n{held}\n[[step]]\n{settles or 'uniform = -0.1'}\n[[step]]\n{settles}\nuniform = -1.5\npoint = [ {{ x = {c}, w = -1 }} ]\n" if i % 4 else
                     f"[plate]\nsize = [4, 2]\nelements = [3, 2]\nD = 12\nnu = 0.3\n[[bed]]\nfrom = [{a}, 0]\nto = [{b}, {d / 2:.3f}]\nmodulus = 20\nface = 0\n"
                     "[[support]]\nnode = 12\nspring = { w = 40 }\n[[support]]\nnode = 1\nspring = { w = 40, wx = 3, wy = 2 }\n[[step]]\nuniform = -1.5\n"
                     f"moment = [ {{ from = [{c}, {c / 4:.3f}], to = [{d}, {d / 2:.3f}], wx = 0.4, wy = -0.7 }} ]\n")
    return texts


def check_beams(texts):
    certified, count = 0, len(texts)
    for text in texts:
        code, said = verdict(problem := file_of("random.toml", text), proof := proof_of(problem))
        check(code == 0, f"{text}\n{code}: {said}")
        certified += sum(step["certified"] for step in proof["steps"])
    check(certified >= count - 1, f"{certified} of {count} beams are certified")
    check_doctored(texts, 5 * count, 1, 0)  # texts without a word or number to spare


# Loads inside the elements of a cantilever that load no node.
CANCELLED = ["[[step]]\npoint = [ { x = 0.1, w = 1 }, { x = 0.3, w = -4 }, { x = 0.5, w = 6 }, { x = 0.7, w = -4 }, { x = 0.9, w = 1 } ]\n",
             "[[step]]\ncurvature = [ { value = 1, to = 0.25 }, { value = -1, from = 0.25, to = 0.75 }, { value = 1, from = 0.75 } ]\n",
             "[[case]]\nname = \"a\"\nuniform = -1\n[[case]]\nname = \"b\"\nuniform = [ { value = -2, to = 0.5 }, { value = -2, from = 0.5 } ]\n"
             "[[combination]]\nname = \"c\"\nterms = { a = 1 }\n[[combination]]\nname = \"0\"\nterms = { a = 1, b = -0.5 }\n"]


def check_cancelled_and_balanced():
    """Tests that loads which cancel hide no wrong bound, and that a certified step is not refused if the largest loads so far
    acted in a step without bounds."""
    for text in CANCELLED:
        problem = file_of("cancelled.toml", CANTILEVER.format("x = [0, 1]") + text)
        proof = proof_of(problem)
        expect(0, text, problem, proof, "(?s)" + ".*; certified" * len(proof["steps"]))
        proof["steps"][0]["error"]["w"] = 1.0
        expect(1, text, problem, proof)
    problem = file_of("balanced.toml", '[beam]\nx = [0, 6, 12]\nEI = 1e4\n[[contact]]\nnode = 2\nsurface = "below"\nface = 0\nstiffness = 1e5\n'
                      '[[step]]\nuniform = -15\n[[step]]\nmove = [ { node = 2, w = -0.001 } ]\n')
    expect(2, "an unloaded step after a balanced one", problem, proof_of(problem),
           "step 2 of 2: 9 numbers are within their bounds; certified; measured by a step without bounds")


def altered(proof, number, *faults):
    """Returns a copy of a proof with faults in a step."""
    copied = copy.deepcopy(proof)
    for fault in faults:
        fault(copied["steps"][number])
    return copied


def check_faults():
    problem = reference / "problems/pb07-three-gap-supports.toml"
    proof = proof_of(problem)
    steps = proof["steps"]
    expect(0, "the proof that is to be doctored", problem, proof)
    check(steps[2]["closed"] == [1, 2, 3], "all pairs are closed in step 3")
    for name, fault in FAULTS.items():
        expect(1, name, problem, altered(proof, 2, fault), "step 3( of 4: REFUSED|: )|is no number")
    expect(0, "a bound of 0.999 millionths of the largest deflection", problem, altered(proof, 2, lambda step: wider(step, 0.999e-6)))
    expect(1, "the factor is that of another state", problem, altered(proof, 2, put("L", steps[0]["L"])))
    bound_less = {"step": 4, "certified": False, "error": None, "because": "lorem"}
    for wanted, name, other in ((1, "steps are exchanged", [steps[0], steps[2], steps[1], steps[3]]), (1, "only the first step", steps[:1]), (1, "no step", []),
                                (1, "a step twice", [*steps, steps[3]]), (2, "a step without bounds", [*steps[:3], bound_less])):
        expect(wanted, name, problem, proof | {"steps": other})
    # Pair 3 is listed twice, and the factor has its spring twice.
    contact = "\n[[contact]]\nnode = 13\nsurface = \"below\"\nface = -0.006\nstiffness = 1.0e5\n"
    twice = proof_of(file_of("twice.toml", problem.read_text().replace("\n[[step]]", contact + "\n[[step]]", 1)))["steps"][2]
    expect(1, "a pair is taken as closed under two numbers", problem, altered(proof, 2, lambda step: step.update(
        {key: twice[key] for key in ("L", "shift", "scale")}, closed=[1, 2, 3, 0], error={kind: 1e6 * bound for kind, bound in step["error"].items()})))
    # An unproved earlier step must not increase the allowed error.
    unloaded = file_of("unloaded.toml", CANTILEVER.format("x = [0, 1]") + "[[step]]\nuniform = -1\n[[step]]\nuniform = 0\n")
    inflated = altered(proof_of(unloaded), 0, lambda step: step.update(certified=False, displacement=[1e200] * 4, error=dict.fromkeys(step["error"], 1e300)))
    expect(0, "an inflated step before an unloaded one", unloaded, inflated)
    inflated["steps"][1]["error"]["w"] = 1e100
    expect(1, "an unloaded state is measured by a deflection that is not certified", unloaded, inflated)
    opens = reference / "problems/pb01-cantilever-tip-stop.toml"
    opened = proof_of(opens)
    in_contact = put("state", ["contact"])
    expect(1, "an open pair is taken as closed", opens, altered(opened, 3, put("closed", [1])))
    expect(1, "an open pair is said to be in contact", opens, altered(opened, 3, in_contact))
    expect(2, "a state that the bounds contradict", opens, altered(opened, 3, in_contact, put("certified", False), put("error", lambda e: e | {"gap": 1.0})))
    for name, (pattern, digit) in OTHERS.items():
        text = problem.read_text()
        changed = re.sub(pattern + r"(-?[0-9.]*[0-9])", lambda m: m.group(0) + ("" if "." in m.group(2) else ".") + "000001" + digit, text, count=1)
        check(changed != text, f"{name} is changed")
        expect(1, f"the proof of a problem in which {name} is another", file_of("other.toml", changed), proof)


def check_mesh_faults():
    """Tests that the line of a mesh's error is refused with any fault, and bounds below it."""
    problem = file_of("mesh.toml", bedded(4)[3])
    proof, number = proof_of(problem), 0  # a bed is in contact along a part of its length
    expect(0, "a line", problem, proof, "(?s).*the mesh's error is proved: [0-9]{2,} numbers$")
    mesh = proof["steps"][number]["mesh"]
    pressing = next(i for i, part in enumerate(mesh["parts"]) if part["certain"])

    def put_at(value, *way):
        def fault(step):
            at = step["mesh"]
            for key in way[:-1]:
                at = at[key]
            at[way[-1]] = value
        return fault
    smaller = {f"the bound on {kind}": put_at(bound / 2, "error", kind) for kind, bound in mesh["error"].items() if kind not in ("gap", "force")}
    faults = smaller | {
        "a displacement of the line": put_at([mesh["u"][9][0] * 1.5, 0.0], "u", 9),
        "a part of the pressure": put_at([x + 1e-3 for x in mesh["parts"][pressing]["before"]], "parts", pressing, "before"),
        "a bed that does not press": put_at([], "parts", pressing, "pressed"),
        "a stretch where no bed is": put_at([[9, 0.0, 1.0]], "parts", pressing, "certain"),
        "no stretch": lambda step: [part.update(certain=[]) for part in step["mesh"]["parts"]],
        "a largest number": put_at(mesh["of"]["w"] / 2, "of", "w"),
        "an extreme": put_at(mesh["extremes"]["shear"]["max"] * 1.001, "extremes", "shear", "max"),
        "an extreme that is not reached": put_at(mesh["extremes"]["w"]["min"] * 1.001, "extremes", "w", "min"),
        "a part too few": lambda step: step["mesh"]["parts"].pop(),
        "a part too many": lambda step: step["mesh"]["parts"].append(mesh["parts"][0]),
        "another end of contact": put_at([1.234], "ends"),
        "halvings": put_at(2, "halvings"), "L": put_at([[0.0] * len(row) for row in mesh["L"]], "L"), "no bounds": lambda step: step["mesh"].pop("error")}
    for name, fault in faults.items():
        expect(1, f"a line with a fault: {name}", problem, altered(proof, number, fault))
    stretch = mesh["parts"][pressing]["certain"][0]
    for name, fault, said in (("a stretch counts twice", put_at([stretch, stretch], "parts", pressing, "certain"), "certain: not in increasing order"),
                              ("a pair before the first", put_at([0], "closed"), "closed: not"), ("a bed's pair, which the line does not have", put_at([1], "closed"), "closed: not"),
                              ("two dofs have one row", put_at([0] * len(mesh["row_of"]), "row_of"), "row_of: two")):
        expect(1, f"a line with a fault: {name}", problem, altered(proof, number, fault), f"(?s).*REFUSED: {said}")


with tempfile.TemporaryDirectory() as scratch:
    folder = Path(scratch)
    check_reference()
    check_faults()
    check_semidefinite()
    check_places()
    check_doctored(check_forms(), *((200, 4, 0) if few else (2000, 40, 1)))
    check_beams(sheared_beams(20 if few else 60))
    check_beams(hinged_beams(20 if few else 60))
    check_beams(bedded(12 if few else 60))
    check_mesh_faults()
    check_cancelled_and_balanced()
least = (30, 25, 0) if few else (150, 140, 1)
check.end(150, **dict(zip(("proved steps", "certified steps", "contradicted"), least)))
