"""Writes matrix.mtx, matrix.dof and matrix.xyz into the working folder, as your program would write them for contct.

A grillage of two girders along x and three cross beams along y. A node has the dofs z, rx = dz/dy and ry = -dz/dx.
"""
EI = {"x": 2.1e8 * 8.36e-5, "y": 2.1e8 * 1.943e-5}  # IPE 300 and IPE 200, kN m^2
GJ = {"x": 8.1e7 * 2.01e-7, "y": 8.1e7 * 6.98e-8}
NODES = {f"{girder}{i + 1}": (2.0 * i, y) for girder, y in (("a", 0.0), ("b", 3.0)) for i in range(5)}
BEAMS = [(f"{g}{i}", f"{g}{i + 1}", "x") for g in "ab" for i in range(1, 5)] + [(f"a{i}", f"b{i}", "y") for i in (2, 3, 4)]


def element(first, second, along):
    """Returns {(dof, dof): stiffness} of an element: bending by z and the slope along the beam, and torsion."""
    h = abs(NODES[second][0] - NODES[first][0]) + abs(NODES[second][1] - NODES[first][1])
    k, sign = EI[along] / h**3, -1.0 if along == "x" else 1.0
    slope, twist = ("ry", "rx") if along == "x" else ("rx", "ry")
    bent = [(f"{first}.z", 1.0), (f"{first}.{slope}", sign), (f"{second}.z", 1.0), (f"{second}.{slope}", sign)]
    beam = [[12 * k, 6 * k * h, -12 * k, 6 * k * h], [6 * k * h, 4 * k * h * h, -6 * k * h, 2 * k * h * h],
            [-12 * k, -6 * k * h, 12 * k, -6 * k * h], [6 * k * h, 2 * k * h * h, -6 * k * h, 4 * k * h * h]]
    entries = {(p, q): s * t * beam[i][j] for i, (p, s) in enumerate(bent) for j, (q, t) in enumerate(bent)}
    ends = [f"{first}.{twist}", f"{second}.{twist}"]
    entries.update({(p, q): (1 if p == q else -1) * GJ[along] / h for p in ends for q in ends})
    return entries


def main():
    labels = [f"{node}.{dof}" for node in NODES for dof in ("z", "rx", "ry")]
    place = {label: i + 1 for i, label in enumerate(labels)}
    total = {}
    for beam in BEAMS:
        for (p, q), value in element(*beam).items():
            if place[p] >= place[q] and value != 0:
                total[place[q], place[p]] = total.get((place[q], place[p]), 0.0) + value
    lines = [f"{row} {column} {value!r}" for (column, row), value in sorted(total.items()) if value != 0]
    with open("matrix.mtx", "w", encoding="ascii") as file:
        file.write("%%MatrixMarket matrix coordinate real symmetric\n% a grillage, kN and m\n")
        file.write(f"{len(labels)} {len(labels)} {len(lines)}\n" + "\n".join(lines) + "\n")
    with open("matrix.dof", "w", encoding="ascii") as file:
        file.write("\n".join(labels) + "\n")
    with open("matrix.xyz", "w", encoding="ascii") as file:
        file.write("# node, x, y, z; m\n" + "".join(f"{node} {x:g} {y:g} 0\n" for node, (x, y) in NODES.items()))


if __name__ == "__main__":
    main()
