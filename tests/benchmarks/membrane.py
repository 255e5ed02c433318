"""membrane.py CONTCT REFERENCE: PB16's files are those that reference/benchmarks/membrane.py writes; on 10, 20 and 40 intervals the
largest error against the exact solution falls to less than a third each time, and the contact forces add up to 2 pi A within 0.2 % at last."""
import sys
import tempfile
from math import pi
from pathlib import Path

contct, reference = (Path(a).resolve() for a in sys.argv[1:])
sys.path[:0] = [str(reference / "benchmarks"), str(Path(__file__).parents[1] / "support")]
from testing import result_of  # noqa: E402
from membrane import A, Membrane, exact  # noqa: E402

NAME = "pb16-membrane-over-ball"


def solved(folder, intervals):
    """The largest error of w, and the sum of the contact forces."""
    membrane = Membrane(intervals)
    membrane.write(folder, NAME)
    step = result_of(contct, "run", f"{NAME}.toml", "--quiet", "--strict", cwd=folder)["steps"][0]
    error = max(abs(w - exact(*place)) for w, place in zip(step["displacement"], membrane.places.values(), strict=True))
    return error, sum(pair["force"] for pair in step["pairs"])


with tempfile.TemporaryDirectory() as work:
    folder = Path(work)
    Membrane(20).write(folder, NAME)
    files = [f"{NAME}.{ending}" for ending in ("toml", "mtx", "dof", "xyz")]
    other = [file for file in files if (folder / file).read_bytes() != (reference / "problems" / file).read_bytes()]
    found = [solved(folder, intervals) for intervals in (10, 20, 40)]
errors, force = [error for error, _ in found], found[-1][1]
print(f"errors {errors}; {force:.5f} presses, exactly {2 * pi * A:.5f}; other files: {', '.join(other) or 'none'}")
falls = all(fine < coarse / 3 for coarse, fine in zip(errors, errors[1:]))
sys.exit(int(bool(other) or not falls or abs(force / (2 * pi * A) - 1) > 2e-3))
