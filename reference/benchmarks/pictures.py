"""Writes a picture of each benchmark, NAME.svg, in this folder:
    PYTHONPATH=build/release python3 reference/benchmarks/pictures.py

As in the cookbook, a picture shows the state at the end of a step by the corrected rule. PB15 is a matrix without
coordinates, and has no picture.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent / "cookbook"))
from pictures import svg  # noqa: E402

# One problem of each family, and the step that is shown.
SHOWN = {"pb01-cantilever-tip-stop": 2, "pb02-beam-over-cantilever": 1, "pb03a-point-load-on-bed-l4": 1, "pb04c-end-loads-on-bed-long": 1,
         "pb05-cantilever-over-flat-obstacle": 6, "pb06-settled-middle-support": 3, "pb07-three-gap-supports": 3, "pb08b-heavy-beam-up-4": 2,
         "pb09a-plate-on-springs-ei-1e6": 1, "pb10-cantilever-gapped-spring": 1, "pb11a-strip-footing-n20": 1, "pb12-two-spans-moving-load": 1,
         "pb13-racks-one-settles": 2, "pb14-gerber-beam": 2, "pb16-membrane-over-ball": 1, "pb17-deep-beam-over-gap": 1, "pb18-rail-joint-over-void": 1,
         "pp01e-unilateral-edges-n8-k1e5": 1, "pp02a-settled-column-n4": 3,
         "pp03d-corners-and-settled-stop-n4": 1, "pp04a-unilateral-edges-settled-column-n6": 3, "pp05a-free-plate-on-bed-n8": 1,
         "pp06-plate-over-settling-line": 1}

if __name__ == "__main__":
    for name, step in SHOWN.items():
        (HERE / f"{name[:4]}.svg").write_text(svg(HERE.parent / f"problems/{name}.toml", step))
