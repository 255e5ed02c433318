"""check_proof.py PROBLEM.toml PROOF.json: verify what `contct run PROBLEM.toml --proof PROOF.json` wrote.

Every bound on an error is verified in rational arithmetic, from the decimals of the problem file, without the program:
certificate.md has the mathematics, proof-format.md the format. Exit 0: all bounds hold; 1: one does not; 2: there are none.
"""
import json
import sys
import tomllib
from fractions import Fraction as F
from os.path import dirname

from check_beam import meant, numbers
from check_plate import dot
from check_problem import Problem


def up(x):
    """x, or a little more (2^-200 of it), with a short denominator."""
    shift = max(0, 200 + x.denominator.bit_length() - abs(x.numerator).bit_length())
    return F(-((-x.numerator << shift) // x.denominator), 1 << shift)


def zeros(rows):
    return [[0] * len(row) for row in rows]


def reach_of(p, s, springs):
    """s_i^2 / mu with S K_A S >= mu I; mu is the shift less Gershgorin's discs of S K_A S - shift I - L L'."""
    S = [F(2)**k for k in s["scale"]]
    rows = [[F(x) + F(low) for x, low in zip(*two)] for two in zip(s["L"], s.get("L_low", zeros(s["L"])))]
    unit = max(x.denominator for row in rows for x in row)
    whole = [[int(x * unit) for x in row] for row in rows]
    first = [i + 1 - len(row) for i, row in enumerate(rows)]
    at, shift, sums = s["row_of"], F(s["shift"]), [F(0)] * p.n
    if sorted(at) != list(range(p.n)) or min(first) < 0:
        raise ValueError("the rows of L are not those of the dofs")
    for dof in range(p.n):
        i = at[dof]
        row = {at[j]: k * S[dof] * S[j] for j, k in p.K[dof].items() if dof not in p.fixed and j not in p.fixed}
        row[i] = (row[i] + springs[dof] * S[dof]**2 if dof not in p.fixed else 1) - shift
        for j in {j for j in row if j <= i} | set(range(first[i], i + 1)):
            k = max(first[i], first[j])
            ll = sum(map(int.__mul__, whole[i][k - first[i]:], whole[j][k - first[j]:])) if k <= j else 0
            error = up(abs(row.get(j, 0) - F(ll, unit * unit)))
            for disc in {i, j}:
                sums[disc] += error
    mu = shift - max(sums)
    if mu <= 0:
        raise ValueError("the stiffness is not shown to be positive definite")
    return [x * x / mu for x in S]


def bounded(p, f, settled, s):
    """The state, what K needs beyond the loads, the pairs' depths, A, and squares: of rho, and of each dof's error per rho."""
    u = [settled.get(dof, F(hi) + F(lo)) for dof, (hi, lo) in enumerate(s["u"])]
    deep = [n * (u[dof] - face) for dof, n, face, _ in p.pairs]
    need = [dot(row.values(), [u[j] for j in row]) - f[i] for i, row in enumerate(p.K)]
    for (dof, n, _, k), d in zip(p.pairs, deep):
        need[dof] += n * k * max(d, 0)
    closed, springs = [i - 1 for i in s["closed"]], [F(0)] * p.n
    for i in closed:
        springs[p.pairs[i][0]] += p.pairs[i][3]
    rho2, reach = F(0), [F(0)] * p.n  # squares: of rho, and of each displacement's error per rho
    if "L" in s:
        reach = reach_of(p, s, springs)
        r = [F(0) if dof in p.fixed else -x for dof, x in enumerate(need)]
        z = [F(0) if dof in p.fixed else F(hi) + F(lo) for dof, (hi, lo) in enumerate(s["z"] or [(0, 0)] * p.n)]
        for dof, row in enumerate(p.K):
            if dof not in p.fixed:
                e = r[dof] - dot(row.values(), [z[j] for j in row]) - springs[dof] * z[dof]
                rho2 += up(r[dof] * z[dof] + z[dof] * e + reach[dof] * e * e)
    elif any(f) or any(u) or any(n * face < 0 for _, n, face, _ in p.pairs):  # nothing acts, and u = 0 is an equilibrium
        raise ValueError("nothing shows that the stiffness is positive definite")
    if sorted(set(closed) & set(range(len(p.pairs)))) != closed or any(deep[i] <= 0 or p.pairs[i][0] in p.fixed or
            deep[i]**2 <= min(reach[p.pairs[i][0]], 1 / p.pairs[i][3]) * rho2 for i in closed):
        raise ValueError("a pair is taken as closed that may be open")
    return u, need, deep, closed, rho2, reach


def statuses(p, s):
    """The pairs that are certainly in contact (True) or separated (False) at a share of a step's load."""
    if s["step"] == 1 and s["share"] <= 0:
        return p.at_first
    x, (f, settled, _) = F(s["share"]), p.loads(p.steps[s["step"] - 1])
    f0, settled0, _ = p.loads(p.steps[s["step"] - 2] if s["step"] > 1 else {})
    f, settled = [a + x * (b - a) for a, b in zip(f0, f)], {i: settled0[i] + x * (settled[i] - settled0[i]) for i in settled}
    _, _, deep, closed, rho2, reach = bounded(p, f, settled, s)
    apart = [d < 0 and d * d > reach[dof] * rho2 and dof not in p.fixed for (dof, _, _, _), d in zip(p.pairs, deep)]
    return [True if i in closed else False if apart[i] else None for i in range(len(apart))]


def check_share(p, step, s):
    """Raises ValueError where an event may happen further from its share than the bound says."""
    for side, after in zip(s["sides"], (False, True), strict=True):
        if abs(side["step"] - step + F(side["share"]) - F(s["fraction"])) > F(s["error"]):
            raise ValueError(f"increment {s['increment']}: a side is further off than the bound")
        known = statuses(p, side)
        if not s["events"] or any(known[e["pair"] - 1] is not ((e["change"] == "make") == after) for e in s["events"]):
            raise ValueError(f"increment {s['increment']}: an event is not certain")


def check(p, step, s):
    """Raises ValueError where a bound does not hold; gives the number of numbers that were looked at."""
    f, settled, own = p.loads(step)
    u, need, deep, closed, rho2, reach = bounded(p, f, settled, s)
    per, held = len(p.names), {dof: (need[dof], p.K[dof][dof]) for dof in p.fixed}
    spread = [0 if dof in p.fixed else reach[dof] for dof in range(p.n)]  # squares per rho: of displacements, then of forces
    claims = [("slope" if dof % per else "w", true, spread[dof]) for dof, true in enumerate(u)]
    for (dof, _, _, k), d in zip(p.pairs, deep):
        claims.append(("force", k * max(d, 0), 0 if d < 0 and d * d > spread[dof] * rho2 else min(k, k * k * spread[dof])))
    for dof, k in p.supports:  # a dof that is fixed twice gives its reaction to the first
        true, square = held.pop(dof, (0, 0)) if k is None else (-k * u[dof], min(k, k * k * spread[dof]))
        claims.append(("moment" if dof % per else "reaction", true, square))
    claims += [v for (e, dofs, _), work in zip(p.elements, own) for v in e.values([u[dof] for dof in dofs], work)]
    told = s["displacement"] + s["force"] + s["reactions"] + s["elements"]
    for number, ((kind, true, square), x) in enumerate(zip(claims, told, strict=True)):
        if number < p.n and "L" not in s and s["error"][kind] is None:
            continue  # it may stand anywhere
        room = F(s["error"][kind]) - abs(F(x) - true)
        if room < 0 or room * room < square * rho2 or (number < p.n and "L" not in s):
            raise ValueError(f"the bound on {kind} does not hold for number {number + 1}")
    return len(claims) if "L" in s else len(claims) - p.n


def main(problem, proof):
    where = "what the files hold"
    try:
        with open(problem, "rb") as file, open(proof, encoding="utf-8") as proofs:
            p, steps = Problem(numbers(tomllib.load(file, parse_float=meant)), dirname(problem)), json.load(proofs)["steps"]
        for i, s in enumerate(steps):
            where = f"step {i + 1} of {len(p.steps)}"
            words = f"{check(p, p.steps[i], s)} numbers are within their bounds" if s["error"] else f"no bounds: {s['because']}"
            for share in s.get("shares", []):
                check_share(p, i + 1, share)
            shares = f", and {len(s['shares'])} shares within theirs" if s.get("shares") else ""
            print(f"{where}: {words}{shares}")
    except (OSError, AttributeError, LookupError, ValueError, TypeError, ArithmeticError) as why:
        print(f"{where}: REFUSED: {why!r}")
        return 1
    return 0 if any(s["error"] for s in steps) else 2


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 3 else __doc__)
