"""Is a stiffness positive definite, or semidefinite, for certain? For check_proof.py, in fractions."""
from fractions import Fraction as F
from math import frexp, sqrt

from check_plate import need


def up(x):
    """x, or a little more (2^-200 of it), with a short denominator."""
    shift = max(0, 200 + x.denominator.bit_length() - abs(x.numerator).bit_length())
    return F(-((-x.numerator << shift) // x.denominator), 1 << shift)


def reach_of(p, s, springs):
    """s_i^2 / mu with S K_A S >= mu I; mu is the shift less Gershgorin's discs of S K_A S - shift I - L L'."""
    S = [F(2)**k for k in s["scale"]]
    rows = [[F(x) + F(low) for x, low in zip(*two)] for two in zip(s["L"], s.get("L_low", [[0] * len(row) for row in s["L"]]))]
    unit = max(x.denominator for row in rows for x in row)
    whole = [[int(x * unit) for x in row] for row in rows]
    first = [i + 1 - len(row) for i, row in enumerate(rows)]
    at, shift, sums = s["row_of"], F(s["shift"]), [F(0)] * p.n
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
    need(mu > 0, "the stiffness is not shown to be positive definite")
    return [x * x / mu for x in S]


def factor_of(p, shift):
    """L of S K S - shift I in doubles, with what reach_of takes besides; None where a pivot is not positive."""
    scale = [-(frexp(float(row[i]))[1] // 2) if row[i] > 0 and i not in p.fixed else 0 for i, row in enumerate(p.K)]
    L, first = [], []
    for i, entries in enumerate(p.K):
        row = {j: float(k * F(2)**(scale[i] + scale[j])) for j, k in entries.items() if i not in p.fixed and j not in p.fixed and j <= i}
        row[i] = row.get(i, 1.0) - shift
        first.append(min(row))
        L.append([])
        for j in range(first[i], i + 1):
            k = max(first[i], first[j])
            x = row.get(j, 0.0) - sum(map(float.__mul__, L[i][k - first[i]:], L[j][k - first[j]:j - first[j]]))
            if j == i and x <= 0:
                return None
            L[i].append(x / L[j][-1] if j < i else sqrt(x))
    return {"scale": scale, "row_of": range(p.n), "shift": shift, "L": L}


def eliminated(p):
    """Is K semidefinite? Exactly, a dof at a time, that with the fewest neighbours first."""
    rows = {i: {j: k for j, k in row.items() if k and j not in p.fixed} for i, row in enumerate(p.K) if i not in p.fixed}
    while rows:
        i = min(rows, key=lambda i: len(rows[i]))
        row = rows.pop(i)
        pivot = row.pop(i, F(0))
        if pivot < 0 or (pivot == 0 and row):
            return False
        for j in row:
            del rows[j][i]
            for k in row:
                rows[j][k] = rows[j].get(k, 0) - row[j] * row[k] / pivot
                if not rows[j][k]:
                    del rows[j][k]
    return True


def semidefinite(p):
    """By a factor of K itself, as it is shown for K_A; where doubles do not give one, exactly if K is small."""
    for factor in (factor_of(p, 2.0**-k) for k in (8, 16, 24, 32, 40)):
        try:
            if factor and reach_of(p, factor, [F(0)] * p.n):
                return True
        except ValueError:
            pass
    return p.n - len(p.fixed) <= 200 and eliminated(p)
