"""scale.py BUILD FIGURE.svg [SECONDS [SIZES]]: processor time and memory against size, of contct and of other programs, as one picture.

Each point is a whole process of a problem by formula, reading and certificate included; CHOLMOD alone, by the path or Newton's method, has
K in memory. A curve ends where a run takes more than SECONDS (120), or fails, or after so many SIZES, or where a program is
missing. Points are printed as they come, with the message of a failure."""
import json
import math
import os
import sys
import tempfile
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / folder) for folder in ("tests/support", "reference/benchmarks")]
from testing import run  # noqa: E402
import calculix  # noqa: E402
from make import problem_of  # noqa: E402

BUILD, FIGURE, SECONDS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), float(sys.argv[3]) if len(sys.argv) > 3 else 120.0
MOST_SIZES = int(sys.argv[4]) if len(sys.argv) > 4 else None
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2"]
# The sizes of a family, and the number of dofs of a size.
FAMILIES = {"rail": ([3, 10, 30, 100, 300, 1000, 3000, 10000], lambda spans: 2 * (100 * spans + 1)),
            "grid": ([8, 16, 32, 64, 128, 256, 512], lambda n: 3 * (n + 1) ** 2)}
# Linux counts the memory of the process that forks to the peak of its child, so a small process must fork.
FORK = """import os, subprocess, sys
process = subprocess.Popen(sys.argv[1:], stderr=subprocess.STDOUT)
_, status, usage = os.wait4(process.pid, 0)
print("\\n", os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)"""


def measured(command, folder):
    """Processor seconds and MiB of a process and its child processes, or None and a message if the process fails."""
    limited = [sys.executable, "-I", "-S", "-c", FORK, "timeout", SECONDS * 4, *command]
    *lines, last = run(*limited, cwd=folder, status=0).stdout.strip().splitlines()
    status, seconds, mib = last.split()
    if status == "124":
        return None, f"more than {SECONDS * 4:g} s"
    if status != "0":
        return None, next((line for line in reversed(lines) if line.startswith("contct")), (lines or ["no message"])[-1])
    return (float(seconds), float(mib)), ""


contct = lambda *options, before=(): lambda name, folder: measured([*before, BUILD / "contct", "run", folder / f"{name}.toml", "--quiet", *options], folder)


def cholmod(method):
    def timed(name, folder):
        point, problem = measured([BUILD / "contct_bench", "--problem", name, "--engine", "updated", "--events", "1", "--rounds", "1",
                                   "--without-kernels", "--method", method, "--json", "rows.json"], folder)
        found = [row for row in json.loads((folder / "rows.json").read_text())["peers"] if row["method"] == method] if point else []
        return ((found[0]["ms"] / 1e3, found[0]["mib"]), "") if found else (None, problem or "no CHOLMOD")
    return timed


def ccx(name, folder):
    """Run CalculiX on a plate without the moments of its loads, held only at corners of elements, to measure time."""
    problem = problem_of(folder / f"{name}.toml")
    step = problem["steps"][0] | {"loads": [load for load in problem["steps"][0]["loads"] if load[1] in calculix.DIRECTIONS]}
    Path(folder, "job.inp").write_text(calculix.deck(problem, step))
    return measured(["ccx", "job"], folder)


def siconos(name, folder):
    """Run Siconos by Lemke's method on a full matrix. The environment variable SICONOS is the folder of its unpacked packages."""
    script = "import sys; sys.path.insert(0, sys.argv[1]); from pathlib import Path; from siconos_lcp import Structure; s = Structure(Path(sys.argv[2])); s.end_of(s.problem.steps[0])"
    unpacked = Path(os.environ.get("SICONOS", "/")) / "usr/lib"
    libraries = unpacked / "x86_64-linux-gnu"
    paths = [f"PYTHONPATH={unpacked}/python3/dist-packages", f"LD_LIBRARY_PATH={libraries}:{libraries}/openblas-pthread", "OPENBLAS_NUM_THREADS=1"]
    return measured(["env", *paths, sys.executable, "-c", script, Path(calculix.__file__).parent, folder / f"{name}.toml"], folder)


METHODS = {
    "1989's way, path": ("#c0392b", contct("--kernels", "fortran", "--engine", "refactor")),
    "quickest engine, path": ("#1f5fa8", contct("--kernels", "corrected")),
    "--final-only": ("#0b8a6a", contct("--final-only")),
    "PETSc, 2 ranks, path": ("#7d3c98", contct("--kernels", "corrected", "--engine", "petsc", before=MPIRUN)),
    "CHOLMOD, updated, path": ("#d68910", cholmod("path, up/downdating")),
    "CHOLMOD, a factor a step": ("#8a6d3b", cholmod("a factor for each step")),
    "CalculiX": ("#444444", ccx),
    "Siconos": ("#c2185b", siconos),
}


def curve(family, timed):
    """The points of a curve: [(dofs, seconds, MiB)]."""
    points, (sizes, dofs) = [], FAMILIES[family]
    for size in sizes[:MOST_SIZES]:
        name = f"{family}-{size}"
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, f"{name}.toml").write_text(run(BUILD / "contct_bench", "--print", "--problem", name, status=0).stdout)
            point, problem = timed(name, Path(folder))
        print(f"  {name}: {'%.3f s, %.0f MiB' % point if point else 'ended: ' + problem}", flush=True)
        if point is not None:
            points.append((dofs(size), *point))
        if point is None or point[0] > SECONDS:
            break
    return points


def panel(left, title, unit, curves, of):
    """A plot of the curves of one family with logarithmic axes. `of`: 1 for seconds, 2 for MiB."""
    width, height, top = 330, 250, 30
    logs = {name: [(math.log10(point[0]), math.log10(max(point[of], 1e-3))) for point in points] for name, points in curves}
    xs, ys = zip(*(place for places in logs.values() for place in places))
    x0, x1, y0, y1 = math.floor(min(xs)), math.ceil(max(xs)), math.floor(min(ys)), math.ceil(max(ys))
    at = lambda x, y: (left + (x - x0) / (x1 - x0) * width, top + height - (y - y0) / (y1 - y0) * height)
    lines = [f'<text x="{left}" y="{top - 10}">{title}</text><rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#999"/>',
             f'<text x="{left + width - 40}" y="{top + height + 30}">dofs</text><text x="{left - 36}" y="{top - 10}">{unit}</text>']
    for (x, y), power in [(at(power, y0), power) for power in range(x0, x1 + 1)]:
        lines.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{y:.1f}" stroke="#ddd"/><text x="{x - 8:.1f}" y="{y + 15:.1f}">1e{power}</text>')
    for (x, y), power in [(at(x0, power), power) for power in range(y0, y1 + 1)]:
        lines.append(f'<line x1="{x:.1f}" x2="{x + width:.1f}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/><text x="{x - 36:.1f}" y="{y + 4:.1f}">1e{power}</text>')
    for name, places in logs.items():
        places, colour = [at(*place) for place in places], METHODS[name][0]
        lines.append(f'<polyline fill="none" stroke="{colour}" stroke-width="1.8" points="{" ".join("%.1f,%.1f" % p for p in places)}"/>')
        lines += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.5" fill="{colour}"/>' for x, y in places]
    return lines


def picture(found):
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1640 340" font-family="sans-serif" font-size="12">',
             '<rect width="1640" height="340" fill="#fff"/>']
    for left, family, title in ((50, "rail", "Beam"), (870, "grid", "Plate")):
        lines += panel(left, f"{title}: time", "s", found[family], 1) + panel(left + 400, f"{title}: memory", "MiB", found[family], 2)
    for x, (name, (colour, _)) in zip(range(50, 1640, 195), METHODS.items()):
        lines.append(f'<line x1="{x}" x2="{x + 25}" y1="330" y2="330" stroke="{colour}" stroke-width="3"/><text x="{x + 30}" y="334">{name}</text>')
    return "\n".join([*lines, "</svg>"]) + "\n"


found = {}
for family in FAMILIES:
    found[family] = []
    for name, (_, timed) in METHODS.items():
        print(f"{name}, {family}", flush=True)
        found[family].append((name, curve(family, timed)))
FIGURE.write_text(picture(found))
print(f"{sum(len(points) for of in found.values() for _, points in of)} points: {FIGURE}")
for family, curves in found.items():
    if len(curves[1][1]) < 2:
        sys.exit(f"scale.py: {family}: found {len(curves[1][1])} points of the quickest engine; allowed: 2 or more")
