"""Proves in fractions that a stiffness matrix is positive definite or semidefinite, for check_proof.py."""
from fractions import Fraction as F
from math import frexp, sqrt

from check_plate import need


def up(x):
    """Returns x >= 0 rounded up by at most about 2^-200 of x, to a short denominator."""
    shift = max(0, 200 + x.denominator.bit_length() - abs(x.numerator).bit_length())
    return F(-((-x.numerator << shift) // x.denominator), 1 << shift)


def reach_of(p, s, springs):
    """Returns s_i^2 / mu for each dof i, where S = diag(s_i), K_A is K plus `springs` on its diagonal, and
    S K_A S >= mu I. By Gershgorin, mu is the shift minus the largest row sum of |S K_A S - shift I - L L'|.
    Raises ValueError unless mu > 0."""
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
    """Returns the factor L of S K S - shift I in doubles, in the form for reach_of; None if a pivot is not positive."""
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
    """Returns True if K is semidefinite, by exact elimination of the dof with the fewest neighbours first."""
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
    """Returns True if K is proved semidefinite: by a factor in doubles or, for at most 200 free dofs, exactly."""
    for factor in (factor_of(p, 2.0**-k) for k in (8, 16, 24, 32, 40)):
        try:
            if factor and reach_of(p, factor, [F(0)] * p.n):
                return True
        except ValueError:
            pass
    return p.n - len(p.fixed) <= 200 and eliminated(p)
