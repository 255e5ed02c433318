"""Writes problems for the browser's test, which are too long or too odd for reference/problems, to a folder."""
import shutil
import sys
from pathlib import Path

folder = Path(sys.argv[1])
write = lambda name, text: (folder / f"{name}.toml").write_text(text, encoding="utf-8")
cantilever = '[beam]\nlength = 2.0\nelements = 8\nEI = 1.0e4\n[[support]]\nnode = 1\nfix = ["w", "theta"]\n'
stop = '[[contact]]\nnode = 9\nsurface = "below"\nface = -0.004\nstiffness = 5.0e4\n'
above = '[[contact]]\nnode = 5\nsurface = "above"\nface = 0.001\nstiffness = 5.0e4\n'
steps = '[[step]]\npoint = [ { node = 9, w = -60.0 } ]\n[[step]]\npoint = [ { node = 9, w = 60.0, theta = 5.0 } ]\n'
write("alone", 'title = "One kernel"\n' + cantilever + stop + above + steps)
write("own-ways", cantilever + stop + above + steps)
# The pair in contact is first, so that drawing in file order would hide it behind the separated pair.
write("two-faces", cantilever + stop + stop.replace('"below"', '"above"').replace("-0.004", "0.01") + steps)
write("settling", '[units]\nlength = "m"\nforce = "kN"\n[beam]\nlength = 8\nelement_size = 1\nEI = 1e4\n[[support]]\nx = [0, 8]\nfix = "w"\n'
      '[[contact]]\nx = [3, 5]\nsurface = "below"\nface = -0.004\nstiffness = 5e3\n[[step]]\nname = "it sinks"\n'
      'uniform = -2\nsettlement = [ { x = 8, w = -0.03 } ]\n[[step]]\nuniform = -1\n')
write("no-pairs", cantilever + "[[step]]\nuniform = -3.0\n")
write("free", 'title = "A free beam & <b>markup</b> \\"quoted\\" </script><script>alert(1)</script> {{data}}"\n'
      "[beam]\nlength = 12.0\nelements = 48\nEI = 1000.0\n[[bed]]\nmodulus = 40.0\nface = 0.0\n"
      "[[step]]\nuniform = -2.0\n[[step]]\nuniform = -2.0\npoint = [ { node = 10, w = -600.0 } ]\n"
      "[[step]]\nuniform = -2.0\npoint = [ { node = 10, w = -60.0 }, { node = 40, w = -900.0 } ]\n")
write("mechanism", '[beam]\nx = [0, 1, 2, 3, 4]\nEI = 100\n[[contact]]\nnode = 2\nsurface = "below"\nface = 0\nstiffness = 10\n'
      '[[contact]]\nnode = 4\nsurface = "below"\nface = 0\nstiffness = 10\n[[step]]\npoint = [ { node = 3, w = -4 } ]\n'
      "[[step]]\npoint = [ { node = 3, w = -4 }, { node = 5, w = -6 } ]\n")
write("never", '[beam]\nx = [0, 1]\nEI = 1\n[[contact]]\nnode = 1\nsurface = "below"\nface = -1\nstiffness = 1\n[[step]]\nuniform = -1\n')
write("corrected", "[beam]\nlength = 2\nelements = 4\nEI = 100\n[[bed]]\nmodulus = 50\nface = -0.01\n[[step]]\nuniform = -3\n")

# A strip on soil under three axles at 22 places, and then under one axle. All 67 loads are different.
strip = 'title = "Slab strip (22 axle places): \\"A & B\\""\n[units]\nlength = "m"\nforce = "kN"\n[beam]\nlength = 24.0\nelements = 48\nEI = 52857.0\n'
strip += "[[bed]]\nmodulus = 20000.0\nface = 0.0\n"
for k in range(22):
    axles = ", ".join(f"{{ x = {x!r}, w = -{100 + (3 * k + i) / 100!r} }}" for i, x in enumerate((0.5 + k, 1.0 + k, 2.0 + k)))
    strip += f'[[step]]\nname = "axles at {0.5 + k}"\npoint = [ {axles} ]\n'
write("strip", strip + '[[step]]\nname = "one axle alone, in the middle of the strip, where the soil is softest"\npoint = [ { x = 12.0, w = -100.66 } ]\n')

# 27 combinations of a strip on a bed, held down by two bolts, one of which has a gap.
write("yard", '[units]\nlength = "m"\nforce = "kN"\n[beam]\nlength = 10.0\nelement_size = 0.2\nEI = 2.0e4\n[[bed]]\nmodulus = 4.0e6\nface = 0.0\n'
      '[[contact]]\nx = [2.0, 8.0]\nsurface = "above"\nface = [0.0, 0.001]\nstiffness = 1.0e4\n[[case]]\nname = "G"\nuniform = -5.0\n'
      '[[combination]]\nname = "G alone"\nterms = { G = 1.0 }\n[[train]]\nname = "fork"\naxles = [ { at = 0.0, w = -80.0 } ]\n'
      "from = 0.0\nto = 10.0\nby = 0.4\nterms = { G = 1.35 }\nfactor = 1.5\n")

# Stops so close together that the numbers of their forces cannot all be beside their arrows.
write("close", '[units]\nlength = "m"\nforce = "kN"\n[beam]\nlength = 8.0\nelement_size = 0.5\nsection = { E = 2.1e8, I = 3.0e-4, A = 0.01, weight = 78.5 }\n'
      '[[contact]]\nx = [0.5, 3.8, 3.9, 4.0, 4.1, 4.2, 7.5]\nsurface = "below"\nface = 0.0\nstiffness = 1.0e3\n'
      '[[case]]\nname = "G"\nself_weight = true\nuniform = -10\n[[combination]]\nname = "G"\nterms = { G = 1.0 }\n'
      '[[combination]]\nname = "2 G"\nterms = { G = 2.0 }\n')

# A beam over 71 stops, which comes to three of them.
write("row", '[beam]\nlength = 72\nelements = 72\nEI = 1e6\n[[support]]\nx = [0, 72]\nfix = "w"\n' + "".join(
    f'[[contact]]\nx = {x}\nsurface = "below"\nface = {0 if x in (18, 36, 54) else -1}\nstiffness = 1e5\n' for x in range(1, 72)) + "[[step]]\nuniform = -1\n")

# A plate on a bed, held down by two bolts. The load's corner (0.15, 0.3) is a multiple of the mesh's spacing.
write("bolts", '[units]\nlength = "m"\nforce = "kN"\n[plate]\nsize = [0.4, 0.4]\nelements = [8, 8]\nE = 2.1e8\nnu = 0.3\nthickness = 0.03\n'
      '[[bed]]\nmodulus = 6.0e6\nface = 0.0\n[[contact]]\nat = [[0.05, 0.2], [0.35, 0.2]]\nsurface = "above"\nface = 0.0\nstiffness = 2.0e5\n'
      '[[step]]\nname = "weight"\nuniform = -50\n[[step]]\nname = "lifted"\nuniform = [ { value = -50 }, { value = 2000, from = [0.05, 0.15], to = [0.15, 0.3] } ]\n')

# A beam of 5001 nodes on soft springs over 1000 stops at increasing depths, with about 2000 increments.
long = '[beam]\nlength = 500.0\nelements = 5000\nEI = 1.0\n[[support]]\nnodes = [1, 5001]\nfix = ["w", "theta"]\n'
long += '[[support]]\nnodes = "2..5000"\nspring = { w = 0.02 }\n'
for k in range(1000):
    long += f'[[contact]]\nnode = {3 + 5 * k}\nsurface = "below"\nface = {-(0.001 + 0.000009 * k)!r}\nstiffness = 0.5\n'
write("long", long + "[[step]]\nuniform = -0.01\n[[step]]\nuniform = -0.0001\n")

# A plate of 5041 nodes over a row of stops.
wide = '[plate]\nsize = [7.0, 7.0]\nelements = [70, 70]\nD = 1.0\nnu = 0.3\n'
wide += '[[support]]\nnodes = [' + ", ".join(str(n) for n in [*range(1, 72), *range(4971, 5042)]) + ']\nfix = ["w"]\n'
for k in range(36):
    wide += f'[[contact]]\nnode = {35 * 71 + 1 + 2 * k}\nsurface = "below"\nface = {-(0.01 + 0.002 * k)!r}\nstiffness = 50.0\n'
write("wide", wide + "[[step]]\nuniform = -0.05\n[[step]]\nuniform = 0.0\n")

# The frame of reference/structures without coordinates. A problem's files are in its own folder.
structures = Path("reference/structures")
write("bare", "".join(line for line in (structures / "frame.toml").read_text().splitlines(True) if not line.startswith("coordinates")))
for name in ("frame.mtx", "frame.dof", "wind.mtx"):
    shutil.copy(structures / name, folder)

# A net of 110 x 110 nodes on springs with 23,980 edges, over a row of stops.
side = 110
entries, count = [], side * side
for at in range(count):
    entries.append(f"{at + 1} {at + 1} 4.5")
    entries += [f"{next + 1} {at + 1} -1" for next, there in ((at + 1, at % side + 1 < side), (at + side, at + side < count)) if there]
for name, rows in (("mtx", ["%%MatrixMarket matrix coordinate real symmetric", f"{count} {count} {len(entries)}", *entries]),
                   ("dof", [f"{at}.z" for at in range(count)]),
                   ("xyz", [f"{at} {at % side} {at // side} 0" for at in range(count)])):
    (folder / f"grid.{name}").write_text("\n".join(rows) + "\n")
net = '[matrix]\nstiffness = "grid.mtx"\ndofs = "grid.dof"\ncoordinates = "grid.xyz"\n'
for k in range(18):
    net += f'[[contact]]\ndof = "{55 * side + 10 + 5 * k}.z"\nsurface = "below"\nface = {-(0.1 + 0.004 * k)!r}\nstiffness = 5.0\n'
point = ", ".join(f'{{ dof = "{55 * side + at}.z", value = -{load} }}' for at in range(5, 105) for load in ["1.0"])
write("grid", net + f"[[step]]\npoint = [ {point} ]\n" + '[[step]]\npoint = [ { dof = "0.z", value = 0 } ]\n')

# Jobs whose report must fit five pages: a crane runway with names, a raft of 10 m x 8 m, and 371 places of a train on 40 sleepers.
crane = (Path(__file__).parents[2] / "reference/cookbook/crane.toml").read_text(encoding="utf-8")
write("crane", crane.replace("[units]", 'project = "Hall 3"\nauthor = "A. Engineer"\n\n[units]').replace('fix = "w"', 'fix = "w"\nname = ["north", "middle"]')
      + '[[watch]]\nname = "span 2"\nfrom = 6.0\n[[watch]]\nname = "columns"\nnames = ["north", "middle"]\n')
write("raft", '[units]\nlength = "m"\nforce = "kN"\n[plate]\nsize = [10.0, 8.0]\nelements = [20, 16]\nE = 3.0e7\nnu = 0.2\nthickness = 0.5\nweight = 25.0\n'
      "[[bed]]\nmodulus = 2.0e4\nface = 0.0\n" + "".join(f'[[case]]\nname = "{name}"\n{load}\n' for name, load in (
          ("G", "self_weight = true"), ("columns", "point = [ { at = [[2.0, 2.0], [8.0, 2.0], [2.0, 6.0], [8.0, 6.0]], w = -400.0 } ]"),
          ("wind", "point = [ { at = [[2.0, 2.0], [2.0, 6.0]], w = 500.0 }, { at = [[8.0, 2.0], [8.0, 6.0]], w = -500.0 } ]")))
      + "".join(f'[[combination]]\nname = "{name}"\nterms = {{ G = {g}, columns = {c}, wind = {w} }}\n' for name, g, c, w in (
          ("ULS", 1.35, 1.5, 0.9), ("wind", 1.35, 1.0, 1.5), ("uplift", 0.9, 0.9, 1.5))))
sleepers = [0.3 + 0.6 * k for k in range(40)]
write("places", '[units]\nlength = "m"\nforce = "kN"\n[beam]\nlength = 24.0\nelement_size = 0.3\nEI = 6.4e3\n[[contact]]\n'
      f'x = {[round(x, 1) for x in sleepers]}\nsurface = "below"\nface = {[-0.002 if k in (10, 11) else 0.0 for k in range(40)]}\nstiffness = 3.0e4\n'
      '[[case]]\nname = "G"\nuniform = -0.6\n[[train]]\nname = "bogies"\naxles = [ { at = 0.0, w = -80.0 }, { at = -2.6, w = -80.0 }, '
      "{ at = -10.4, w = -80.0 }, { at = -13.0, w = -80.0 } ]\nfrom = 5.5\nto = 24.0\nby = 0.05\nterms = { G = 1.0 }\n")
