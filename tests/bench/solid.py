"""solid.py N FOLDER: writes FOLDER/solid-N.toml for contct_bench --problem, and the problem's matrix, made by CalculiX:
4 N x N x N bricks of side 1, clamped at x = 0, over a spring with a gap under each node of the lower face, under a load at the free end."""
import math
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "peer"))
from block import Block  # noqa: E402

n, folder = int(sys.argv[1]), Path(sys.argv[2])
phi = lambda i: i * 0.6180339887498949 - math.floor(i * 0.6180339887498949)
places = [(i, j) for i in range(1, 4 * n + 1) for j in range(n + 1)]
supports = [((i, j, 0), -0.5 * (0.05 + 0.95 * phi(number)) * (i / (4 * n)) ** 2, 20 * (0.7 + 0.6 * phi(2 * number)))
            for number, (i, j) in enumerate(places, 1)]
block = Block(f"solid-{n}", (4 * n, n, n), (4 * n, n, n), supports, (4 * n, n // 2, n), [-40 * n])
folder.joinpath(f"{block.name}.inp").write_text(block.matrix_deck())
subprocess.run(["ccx", block.name], cwd=folder, stdout=subprocess.DEVNULL, check=True)
folder.joinpath(f"{block.name}.toml").write_text(block.problem())
