"""check_proof.py PROBLEM.toml PROOF.json: verifies what `contct run PROBLEM.toml --proof PROOF.json` wrote.

Verifies every bound on an error, every pair's state and every verdict in rational arithmetic, from the decimals of the
problem file, without the program. certificate-proof.md has the mathematics, proof-format.md the format.
Exit 0: the bounds of every step hold, and its verdict follows from them; 1: something is false, missing or cannot be
read; 2: nothing is false, but a step has no bounds, or a step that is not certified has a pair in a wrong state.
"""
import sys
import tomllib
from decimal import Decimal
from fractions import Fraction as F
from os.path import dirname
from types import SimpleNamespace

from check_definite import reach_of, semidefinite, up
from check_format import check_format, parsed
from check_mesh import check_mesh
from check_plate import dot, need
from check_problem import Problem

MILLIONTH = F(1, 10**6) * (1 + F(1, 2**40))  # a little more, because the program compares doubles

def bounded(p, f, settled, s):
    """Returns the state u, K u + contact forces - f, the pairs' depths beyond their faces, rho^2, and each dof's c.

    The error of a dof in u is bounded by error^2 <= c rho^2. f: the loads; settled: the settlements of fixed dofs.
    """
    u = [settled.get(dof, F(hi) + F(lo)) for dof, (hi, lo) in enumerate(s.get("u", [(0, 0)] * p.n))]
    deep = [n * (p.seen(i, u) - face) for i, (_, n, face, _) in enumerate(p.pairs)]
    needed = [dot(row.values(), [u[j] for j in row]) - f[i] for i, row in enumerate(p.K)]
    for (dof, n, _, k), other, d in zip(p.pairs, p.others, deep):
        needed[dof] += n * k * max(d, 0)
        if other is not None:
            needed[other] -= n * k * max(d, 0)
    for dof, n, face, k in p.held:
        needed[dof] += n * k * max(n * (u[dof] - face), 0)
    if "L" not in s:  # nothing acts, and u = 0 is an equilibrium
        need(not any(f) and not any(u) and all(n * face >= 0 for _, n, face, _ in p.pairs + p.held), "something acts, and there is no L")
        return u, needed, deep, F(0), [F(0)] * p.n
    closed, springs = [i - 1 for i in s["closed"]], [F(0)] * p.n
    A = SimpleNamespace(n=p.n, fixed=p.fixed, K=[dict(row) for row in p.K])  # off the diagonal also springs between two dofs
    for i in closed:
        dof, other, k = p.pairs[i][0], p.others[i], p.pairs[i][3]
        springs[dof] += k
        if other is not None:
            springs[other] += k
            A.K[dof][other] = A.K[other][dof] = A.K[dof].get(other, 0) - k
    reach, rho2 = reach_of(A, s, springs), F(0)
    p.definite = p.definite or not closed
    r = [F(0) if dof in p.fixed else -x for dof, x in enumerate(needed)]
    z = [F(0) if dof in p.fixed else F(hi) + F(lo) for dof, (hi, lo) in enumerate(s["z"] or [(0, 0)] * p.n)]
    for dof, row in enumerate(A.K):
        if dof not in p.fixed:
            e = r[dof] - dot(row.values(), [z[j] for j in row]) - springs[dof] * z[dof]
            rho2 += up(r[dof] * z[dof] + z[dof] * e + reach[dof] * e * e)
    for i, dof, k, d in ((i, p.pairs[i][0], p.pairs[i][3], deep[i]) for i in closed):
        need(dof not in p.fixed and d > 0 and d * d > min(reach_of_pair(p, s, reach, i), 1 / k) * rho2, "a pair is taken as closed that may be open")
    return u, needed, deep, rho2, reach


def reach_of_pair(p, s, reach, i):
    """Returns c of a pair's displacement: (s_i + s_j)^2 / mu for its dofs i and j, s_i^2 / mu for one dof."""
    dof, other = p.pairs[i][0], p.others[i]
    if dof in p.fixed:
        return 0
    return reach[dof] * (1 if other is None or "L" not in s else 1 + F(2)**(s["scale"][other] - s["scale"][dof]))**2


def stiff(p, k, otherwise):
    """Returns the lesser of two squares of bounds on a force; the first, a stiffness, only if K is semidefinite."""
    return min(k, otherwise) if p.definite else otherwise


def spread_of(p, s, reach, dof):
    """Returns c of a fixed dof's reaction: K_jj, or of a matrix the square of the sum of |K_ij| s_j, over mu."""
    free = {j: abs(k) for j, k in p.K[dof].items() if j not in p.fixed}
    if "L" not in s or p.whole or not free:
        return p.K[dof][dof] if p.whole else F(0)
    first = min(free)
    return reach[first] * sum(k * F(2)**(s["scale"][j] - s["scale"][first]) for j, k in free.items())**2


def claims_of(p, s, own, u, needed, deep, rho2, reach):
    """Returns (kind, value in the state u, c) for each number of the proof file in order, with error^2 <= c rho^2."""
    per, held = len(p.names), {dof: (needed[dof], spread_of(p, s, reach, dof)) for dof in p.fixed}
    spread = [0 if dof in p.fixed else reach[dof] for dof in range(p.n)]  # c of each displacement
    claims = [("slope" if dof % per else "w", true, spread[dof]) for dof, true in enumerate(u)]
    for i, ((_, _, _, k), d) in enumerate(zip(p.pairs, deep)):
        square = reach_of_pair(p, s, reach, i)
        claims.append(("force", k * max(d, 0), 0 if d < 0 and d * d > square * rho2 else stiff(p, k, k * k * square)))
    for dof, k in p.supports:  # of a dof that is fixed twice, the first support has the reaction
        true, square = held.pop(dof, (0, 0)) if k is None else (-k * u[dof], stiff(p, k, k * k * spread[dof]))
        claims.append(("moment" if dof % per else "reaction", true, square))
    return claims + [v for (e, dofs, _), work in zip(p.elements, own) for v in e.values([u[dof] for dof in dofs], work)]


def sizes_of(p, f, settled, told, largest):
    """Returns the size of each kind of number, and its allowed absolute error (certificate-proof.md, "Sizes").

    `told`: the largest number of each kind in the step; `largest`: the largest size on the path so far, which is used
    if nothing acts on the structure.
    """
    gap = {"gap": max(told.get("gap", F(0)), told.get("w", F(0)))}
    if not any(f) and not any(p.acting.values()) and not any(settled.values()) and all(n * face >= 0 for _, n, face, _ in p.pairs):
        return {kind: max(x, largest.get(kind, F(0))) for kind, x in (largest | gap).items()}, {}
    per, size = len(p.names), told | gap
    acting = {kind: max([abs(x) for dof, x in enumerate(f) if (dof % per > 0) == (kind == "moment")] + [F(0)]) for kind in ("force", "moment")}
    forces = max([acting["force"]] + [told.get(kind, F(0)) for kind in ("force", "reaction", "shear")])
    size |= dict.fromkeys(("force", "reaction", "shear"), forces)
    size["moment"] = max(acting["moment"], told.get("moment", F(0)), forces * p.span)
    moved = [max([0 if any(f) else p.K[dof][dof] * abs(x) for dof, x in settled.items() if (dof % per > 0) == slopes] + [F(0)]) / 2**70 for slopes in (False, True)]
    moment = max(moved[1], moved[0] * p.span)
    force = max(size["moment"] / 2**60, moment) / p.span if p.span else moved[0]
    bends = {"slope": size["w"] / p.span / 2**60} if p.span else {}
    return size, dict.fromkeys(("force", "reaction", "shear"), force) | dict.fromkeys(("w", "gap"), size.get("slope", 0) * p.span / 2**60) | {"moment": moment} | bends


def check_pairs(p, s, deep, rho2, reach, told):
    """Raises ValueError if the bound on gap is false for a pair. Returns the pairs, from 1, with proved wrong states."""
    error, wrong = F(s["error"]["gap"]), []
    for i, ((_, n, _, _), face, d, state) in enumerate(zip(p.pairs, p.told_faces, deep, s["state"])):
        square = reach_of_pair(p, s, reach, i) * rho2
        gap = F(0) if state == "contact" else F(n * (face - p.seen(i, s["displacement"])))
        least, most = -d - (gap - error), gap + error + d  # from -d, the gap of u, to the ends of the bound
        need(gap <= error or least >= 0 and least * least >= square, f"the bound on gap does not hold for pair {i + 1}")
        need(most >= 0 and most * most >= square, f"the bound on gap does not hold for pair {i + 1}")
        told["gap"] = max(told.get("gap", F(0)), abs(gap))
        if (d if state == "separated" else -d) > 0 and d * d > square:
            wrong.append(i + 1)
    return wrong


def check(p, step, s, largest):
    """Raises ValueError if a claim is false. Returns the message, and True if every claim of the step is proved."""
    check_format(p, s)
    if s["error"] is None:
        largest[None] = F(0)  # the sizes of this step are not known
        return f"no bounds: {s['because']}", False
    f, settled, own = p.loads(step)
    u, needed, deep, rho2, reach = bounded(p, f, settled, s)
    p.definite = p.definite or semidefinite(p)
    need(p.definite or (p.rounded and "L" in s), "the stiffness is not shown to be positive semidefinite")
    claims = claims_of(p, s, own, u, needed, deep, rho2, reach)[0 if "L" in s else p.n:]
    error, told = {kind: F(bound) for kind, bound in s["error"].items() if bound is not None}, {}
    for number, ((kind, true, square), x) in enumerate(zip(claims, s.get("displacement", []) + s["force"] + s["reactions"] + s["elements"], strict=True)):
        room = error[kind] - abs(F(x) - true)
        need(room >= 0 and room * room >= square * rho2, f"the bound on {kind} does not hold for number {number + 1}")
        told[kind] = max(told.get(kind, F(0)), abs(F(x)))
    for (e, dofs, _), work in zip(p.elements, own) if len(p.lines) == 1 else []:
        told |= {kind: max(told.get(kind, F(0)), x) for kind, x in e.middle([u[dof] for dof in dofs], work) if kind in error}
    wrong = check_pairs(p, s, deep, rho2, reach, told) if "state" in s and p.pairs else []
    size, besides = sizes_of(p, f, settled, told, largest)
    sure = {kind: max(x - error[kind], F(0)) for kind, x in told.items()}  # proved sizes: without a certificate numbers may be too large
    largest.update({kind: max(x, largest.get(kind, F(0))) for kind, x in sizes_of(p, f, settled, sure, largest)[0].items()})
    large = [kind for kind, bound in error.items() if bound > size.get(kind, 0) * MILLIONTH + besides.get(kind, 0)]
    unsized = large and not besides and None in largest  # sizes of an unloaded step may be those of a step without bounds
    need(not (s["certified"] and large) or unsized, f"certified, with bounds that are too large: {large}")
    need(not (s["certified"] and wrong), f"certified, with pairs that are not as they are said to be: {wrong}")
    words = f"{len(claims)} numbers are within their bounds; {'' if s['certified'] else 'not '}certified"
    words += f"; measured by a step without bounds: {large}" if unsized and s["certified"] else ""
    if "mesh" in s:
        words += check_mesh(p, s["mesh"], f, settled, own, s["displacement"] + s["force"] + s["reactions"] + s["elements"], s["state"])
    return words + (f"; not as they are said to be: pairs {wrong}" if wrong else ""), not wrong


def words_of(why):
    if isinstance(why, KeyError):
        return f"{why} is missing, or is no name that stands there"
    return str(why) if isinstance(why, (ValueError, OSError)) else f"a value is of another kind than it should be ({why!r})"


def main(problem, proof):
    where, largest, shown = "what the files hold", {}, []
    try:
        with open(problem, "rb") as file, open(proof, encoding="utf-8") as proofs:
            steps = parsed(proofs)
            p = Problem(tomllib.load(file, parse_float=Decimal), dirname(problem), next((len(s["elements"]) for s in steps if type(s.get("elements")) is list), None))
            need(len(steps) == len(p.steps), f"{len(steps)} steps for {len(p.steps)} of the problem")
        for i, s in enumerate(steps):
            where = f"step {i + 1} of {len(p.steps)}"
            words, all_shown = check(p, p.steps[i], s, largest)
            shown.append(all_shown)
            print(f"{where}: {words}")
    except Exception as why:  # whatever stands in the files, the answer is a message
        print(f"{where}: REFUSED: {words_of(why)}")
        return 1
    return 0 if all(shown) else 2


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 3 else __doc__)
