"""Small problems of each kind, and lines of options that together have every option of contct run."""

ENDS = '[[support]]\nx = [0, 4]\nfix = "w"\n'
CLAMP = '[[support]]\nnode = 1\nfix = ["w", "theta"]\n'
STOP = '[[contact]]\nnode = 3\nsurface = "below"\nface = -1e-4\nstiffness = 1e4\n'
BED = "[[bed]]\nmodulus = 900\nface = 0\n"
BEAM = "[beam]\nlength = 4\nelements = 4\n"
PLAIN = BEAM + "EI = 1e4\n"
SECTION = BEAM + "section = { E = 2.1e8, I = 2.5e-4, W = 1.6e-3, A = 1.4e-2, weight = 78.5, G = 8.1e7, As = 4e-3 }\n"
PLATE = "[plate]\nsize = [2, 1]\nelements = [2, 2]\nnu = 0.2\n"
THICK = PLATE + "E = 3e7\nthickness = 0.1\n"
EDGE = '[[support]]\nnodes = "1..3"\nfix = ["w", "wx", "wy"]\n'
UNDER = STOP.replace("3", "5", 1)
EVEN = "[[step]]\nuniform = -2\n"
CASES = '[[case]]\nname = "G"\nuniform = -2\n[[case]]\nname = "Q"\npoint = [ { node = 3, w = 3 } ]\n'
SUMS = CASES + "".join(f'[[combination]]\nname = "{q}"\nterms = {{ G = 1.35, Q = {q} }}\n' for q in (1.5, 9, -1, 12))
TRAIN = '[[train]]\nname = "cart"\naxles = [ { at = 0, w = -3 }, { at = 1.1, w = -2 } ]\nfrom = 0\nto = 2\nby = 1\nterms = { G = 1 }\nfactor = 1.2\n'
MATRIX = '[matrix]\nstiffness = "k.mtx"\ndofs = "k.dof"\n'
OF_DOF = '[[contact]]\ndof = "1.2"\nsurface = "below"\nface = -1e-3\nstiffness = 10\n'
PULL = '[[step]]\npoint = [ { dof = "1.2", value = -1 }, { dof = "2.2", value = -5 } ]\n'
UNITS = 'title = "Träger"\n[units]\nlength = "m"\nforce = "kN"\n'

# The files that problems name.
FILES = {"k.mtx": "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 9\n2 1 -3\n2 2 8\n3 2 -2\n3 3 7\n",
         "k.dof": "1.2\n2.2\n2.6\n", "k.xyz": "1 0 0 0\n2 1 0 0\n",
         "j.sti": "1 1 9\n1 2 -3\n2 2 8\n2 3 -2\n3 3 7\n", "j.dof": "1.2\n2.2\n2.6\n"}

KINDS = {
    "beam": PLAIN + CLAMP + STOP + EVEN,
    "beam without pairs": PLAIN + ENDS + EVEN,
    "beam with a bed and a hinge": PLAIN + CLAMP + BED + "[[hinge]]\nnode = 3\nstiffness = 900\n" + EVEN,
    "beam on a bed alone": PLAIN + BED + EVEN,
    "beam with a curved bed": PLAIN + BED.replace("face = 0", "face = { polynomial = [0, -1e-4] }") + EVEN,
    "section": SECTION + ENDS + STOP + EVEN,
    "section on a bed": SECTION + ENDS + BED + EVEN,
    "self-weight": SECTION + ENDS + '[[case]]\nname = "G"\nself_weight = true\n[[combination]]\nname = "1"\nterms = { G = 1 }\n',
    "plate by D": PLATE + "D = 20\n" + EDGE + EVEN,
    "plate by thickness": THICK + EDGE + EVEN,
    "plate on a bed": THICK + BED + EVEN,
    "plate with loads of every kind": THICK + EDGE + UNDER + "[[step]]\nuniform = [ { value = -2, from = [0.1, 0.2], to = [1.3, 0.7] } ]\n"
    "point = [ { node = 5, w = 1, wx = 1, wy = 1 } ]\nmoment = [ { wx = 2, wy = -1, to = [0.6, 0.8] } ]\nsettlement = [ { node = 1, wx = 1e-3, wy = 1e-3 }, { node = 2, w = 1e-3 } ]\nmove = [ { node = 5, w = 0.01 } ]\n",
    "matrix": MATRIX + OF_DOF + PULL,
    "matrix with coordinates": MATRIX + 'coordinates = "k.xyz"\n' + OF_DOF + PULL,
    "pair between two dofs": MATRIX + OF_DOF.replace("surface", 'other = "2.2"\nsurface') + PULL,
    "settlement of a matrix": MATRIX + '[[support]]\ndof = "2.6"\nspring = 3.0\n[[support]]\ndof = "1.2"\nfix = true\n[[step]]\nsettlement = [ { dof = "1.2", value = 0.1 } ]\n',
    "calculix": '[calculix]\njob = "j"\n' + OF_DOF + PULL,
    "combinations": PLAIN + ENDS + STOP + SUMS,
    "combinations of a plate": THICK + EDGE + UNDER + SUMS,
    "train": PLAIN + ENDS + STOP + CASES + TRAIN,
    "train at many places": PLAIN + ENDS + STOP + CASES + TRAIN.replace("by = 1", "by = 0.05"),
    "names": 'project = "P"\nauthor = "A"\nrevision = "1"\n' + UNITS + PLAIN + ENDS + 'name = ["A", "B"]\n' + STOP + 'name = "S"\n' + BED + 'name = "soil"\n' + SUMS
    + '[[watch]]\nname = "left"\nto = 2\n[[watch]]\nname = "ends"\nnames = ["A", "B", "S", "soil"]\n',
    "units": UNITS + PLAIN + ENDS + STOP + BED + EVEN,
    "mechanism": PLAIN + STOP + EVEN,
    "mechanisms of combinations": PLAIN + BED + SUMS,
    "mechanism of the only combination": PLAIN + ENDS.replace("[0, 4]", "0") + BED + '[[case]]\nname = "Q"\nuniform = 2\n[[combination]]\nname = "1"\nterms = { Q = 1 }\n',
    "lifted off": PLAIN + ENDS.replace("[0, 4]", "0") + STOP.replace("-1e-4", "0") + EVEN + EVEN.replace("-", ""),
    "unloaded": PLAIN + ENDS + STOP + EVEN.replace("-2", "0"),
    "curvatures": PLAIN + ENDS + "[[step]]\ncurvature = [ { value = 1e-3, to = 3 }, { value = 2e-3 } ]\n",
    "settlement and moved face": SECTION + CLAMP + STOP + "[[step]]\nsettlement = [ { node = 1, w = -0.1, theta = 0.1 } ]\nmove = [ { node = 3, w = 0.1 } ]\n",
    "elastic supports": PLAIN + "[[support]]\nx = [0, 4]\nspring = { w = 50, theta = 10 }\n" + STOP + EVEN,
    "loads between nodes": PLAIN + ENDS + "[[step]]\npoint = [ { x = 1.3, w = -3, theta = 1 } ]\nuniform = [ { polynomial = [1, 2], from = 0.3, to = 2.1 } ]\n",
    "loads of many parts": PLAIN + ENDS + f"[[step]]\npoint = [ {'{ node = 3, w = 1 }, ' * 40} ]\n",
    "steps": PLAIN + CLAMP + STOP + EVEN + '[[step]]\nname = "up"\nuniform = [ { value = 3, elements = [1, 3] }, { polynomial = [0, 1], elements = "2..3" } ]\n',
}

LINES = [
    ["--envelope", "--detail", "--csv", "t.csv", "--log", "t.log", "--trace", "t.trace", "--junit", "t.xml", "--markdown", "t.md", "--proof", "t.proof"],
    ["--html", "page.html", "--appendix", "--compare", "all", "--allow-outside"],
    ["--kernels", "fortran,cpp", "--engine", "refactor", "--max-increments", "50", "--strict", "--node", "1"],
    ["--kernels", "corrected,fortran", "--free-run"],
    ["--refine", "--vtu", "t.vtu"],
    ["--final-only"],
]


def runs_of_kinds():
    """Yields (problem, options) for each kind with each line of options that its structure allows."""
    for text in KINDS.values():
        of_dofs = "dof = " in text
        for line in LINES:
            if not (of_dofs and "--refine" in line):  # a matrix has no elements to halve
                yield text, ["1.2" if of_dofs and word == "1" else word for word in line]
