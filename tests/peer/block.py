"""Writes blocks of bricks over springs with gaps, as decks for CalculiX and as problem files with CalculiX's matrix."""

# The range of a spring's table in the problem's lengths. The range is wide, because the force is constant outside the
# range and Newton's first steps may go far. A second point is near the solution, since the rounding of the far point
# would move the face of a stiff spring.
FAR_AWAY, NEAR = 1e6, 4


field = lambda x: f"{float(x):.12e}"  # CalculiX cuts a field after 20 characters


class Block:
    """A block of C3D8I bricks, clamped at x = 0, over springs with gaps.

    supports: (node, face, stiffness) of each spring. Each entry of `loads` is a step with this load along z at
    `loaded`.
    """

    YOUNGS = 1e4
    # Factors of displacements and forces in a deck of peer_deck. Displacements are so small that CalculiX's NLGEOM
    # finds no rotation; forces are large because CalculiX treats forces far below 0.01 as zero.
    SCALE, FORCE_SCALE = 1e-8, 1e6

    def __init__(self, name, bricks, size, supports, loaded, loads):
        self.name, self.bricks, self.size, self.loads = name, bricks, size, loads
        self.supports = [(self.at(*place), face, stiffness) for place, face, stiffness in supports]
        self.loaded = self.at(*loaded)
        self.places = [(i, j, k) for i in range(bricks[0] + 1) for j in range(bricks[1] + 1) for k in range(bricks[2] + 1)]

    def at(self, i, j, k):
        return (i * (self.bricks[1] + 1) + j) * (self.bricks[2] + 1) + k + 1

    def where(self, node):
        return [length * i / n for length, i, n in zip(self.size, self.places[node - 1], self.bricks)]

    def mesh(self, modulus):
        lines = ["*NODE,NSET=ALL", *(f"{n},{','.join(map(field, self.where(n)))}" for n in range(1, len(self.places) + 1))]
        lines.append("*ELEMENT,TYPE=C3D8I,ELSET=BLOCK")
        cells = [place for place in self.places if all(i < n for i, n in zip(place, self.bricks))]
        for element, (i, j, k) in enumerate(cells, 1):
            corners = [self.at(i + di, j + dj, k + up) for up in (0, 1) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
            lines.append(",".join(map(str, [element, *corners])))
        lines.append(f"*MATERIAL,NAME=M\n*ELASTIC\n{field(modulus)},0.3\n*DENSITY\n1.\n*SOLID SECTION,ELSET=BLOCK,MATERIAL=M\n*BOUNDARY")
        lines += [f"{self.at(*place)},1,3" for place in self.places if place[0] == 0]
        return "\n".join(lines) + "\n", len(cells)

    def matrix_deck(self):
        """Returns the deck for which CalculiX writes the stiffness matrix."""
        return self.mesh(self.YOUNGS)[0] + "*STEP\n*FREQUENCY,SOLVER=MATRIXSTORAGE\n1\n*END STEP\n"

    def peer_deck(self, load):
        """Returns the deck of a nonlinear run under a load. The fixed nodes of springs follow the block's nodes."""
        text, element = self.mesh(self.YOUNGS * self.FORCE_SCALE / self.SCALE)
        for ground, (node, face, stiffness) in enumerate(self.supports, len(self.places) + 1):
            x, y, z = self.where(node)
            element += 1
            text += f"*NODE,NSET=GROUND\n{ground},{field(x)},{field(y)},{field(z - self.size[2] / 10)}\n" \
                    f"*ELEMENT,TYPE=SPRINGA,ELSET=S{ground}\n{element},{node},{ground}\n*SPRING,ELSET=S{ground},NONLINEAR\n"
            for end in (-FAR_AWAY, -NEAR):
                text += f"{field(stiffness * end * self.FORCE_SCALE)},{field((face + end) * self.SCALE)}\n"
            text += f"0.,{field(face * self.SCALE)}\n0.,{field((face + FAR_AWAY) * self.SCALE)}\n"
        text += f"*BOUNDARY\nGROUND,1,3\n*STEP,NLGEOM\n*STATIC\n1.,1.\n*CLOAD\n{self.loaded},3,{field(load * self.FORCE_SCALE)}\n"
        return text + "*NODE PRINT,NSET=ALL\nU\n*NODE PRINT,NSET=GROUND\nRF\n*END STEP\n"

    def problem(self):
        """Returns the problem file with the matrix that CalculiX writes."""
        text = f'title = "{self.name}"\n\n[calculix]\njob = "{self.name}"\n'
        for node, face, stiffness in self.supports:
            text += f'\n[[contact]]\ndof = "{node}.3"\nsurface = "below"\nface = {face}\nstiffness = {stiffness}\n'
        return text + "".join(f'\n[[step]]\npoint = [ {{ dof = "{self.loaded}.3", value = {load} }} ]\n' for load in self.loads)
