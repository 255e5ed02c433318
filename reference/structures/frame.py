"""Writes frame.mtx, frame.dof, frame.xyz and wind.mtx into the working folder, as another program would for contct.

A portal frame of Hermite beams with axial stiffness. A node has the dofs x, y and r, the rotation counter-clockwise.
The supports are in frame.toml.
"""

EA = 1.05e9  # N
EI = 4.2e6  # N m^2

# Left column upwards, beam to the right, right column upwards; m. Node n is nodes[n - 1].
nodes = [(0, 0), (0, 1), (0, 2), (0, 3), (1, 3), (2, 3), (3, 3), (4, 3), (4, 0), (4, 1), (4, 2)]
elements = [(1, 2), (2, 3), (3, 4), (4, 5), (5, 6), (6, 7), (7, 8), (9, 10), (10, 11), (11, 8)]


def stiffness(h):
    """Returns the stiffness matrix of an element along x: u, v, r at its first node, then at its second."""
    k = EI / h**3
    a = EA / h
    return [
        [a, 0, 0, -a, 0, 0],
        [0, 12 * k, 6 * k * h, 0, -12 * k, 6 * k * h],
        [0, 6 * k * h, 4 * k * h * h, 0, -6 * k * h, 2 * k * h * h],
        [-a, 0, 0, a, 0, 0],
        [0, -12 * k, -6 * k * h, 0, 12 * k, -6 * k * h],
        [0, 6 * k * h, 2 * k * h * h, 0, -6 * k * h, 4 * k * h * h],
    ]


def assemble():
    """Returns the lower triangle of K as {(row, column): value}, from 0."""
    matrix = {}
    for first, second in elements:
        (xa, ya), (xb, yb) = nodes[first - 1], nodes[second - 1]
        h = abs(xb - xa) + abs(yb - ya)  # every element is parallel to an axis
        c, s = (xb - xa) / h, (yb - ya) / h
        turn = [[c, s, 0], [-s, c, 0], [0, 0, 1]]
        local = stiffness(h)
        dofs = [3 * (n - 1) + i for n in (first, second) for i in range(3)]
        for i in range(6):
            for j in range(6):
                value = sum(
                    turn[p][i % 3] * local[i // 3 * 3 + p][j // 3 * 3 + q] * turn[q][j % 3]
                    for p in range(3)
                    for q in range(3)
                )
                if dofs[i] >= dofs[j] and value != 0:
                    place = (dofs[i], dofs[j])
                    matrix[place] = matrix.get(place, 0.0) + value
    return matrix


def write(name, lines):
    with open(name, "w", encoding="ascii", newline="\n") as file:
        file.write("\n".join(lines) + "\n")


def main():
    matrix = assemble()
    size = 3 * len(nodes)
    write(
        "frame.mtx",
        ["%%MatrixMarket matrix coordinate real symmetric", "% portal frame, N and m", f"{size} {size} {len(matrix)}"]
        + [f"{row + 1} {column + 1} {value!r}" for (row, column), value in sorted(matrix.items())],
    )
    write("frame.dof", [f"{n + 1}.{name}" for n in range(len(nodes)) for name in ("x", "y", "r")])
    write("frame.xyz", ["# node, x, y; m"] + [f"{n + 1} {x} {y}" for n, (x, y) in enumerate(nodes)])
    # 8 kN to the right, on nodes 2 to 4 of the left column; 20 kN down on the middle of the beam.
    load = [0.0] * size
    for node, x, y in ((2, 3e3, 0.0), (3, 3e3, 0.0), (4, 2e3, 0.0), (6, 0.0, -2e4)):
        load[3 * (node - 1)] += x
        load[3 * (node - 1) + 1] += y
    write(
        "wind.mtx",
        ["%%MatrixMarket matrix array real general", "% wind from the left, and the beam's load", f"{size} 1"]
        + [repr(value) for value in load],
    )


if __name__ == "__main__":
    main()
