"""petsc.py CONTCT REFERENCE [MPIEXEC RANKS]: `contct run --engine petsc`, a factor that the ranks of an MPI job share.

With MPIEXEC, tests that RANKS ranks give the events, shares of the step, statuses and certificates of one process with
the engine `updated` for a beam, plates and matrices of REFERENCE, and D within the error bounds; that a refusal is one
message with exit status 2 and leaves no file; and the exit status of a mechanism. Without MPIEXEC, if PETSc is not
found, tests that the message says how to install PETSc. The program contct itself never links MPI or PETSc.
"""
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import result_of, run  # noqa: E402

PROBLEMS = ["problems/pb07-three-gap-supports.toml", "problems/pp01g-unilateral-edges-n16-k1e5.toml",
            "problems/pp02b-settled-column-n8.toml", "problems/pp05b-free-plate-on-bed-n12.toml", "structures/frame.toml",
            "structures/calculix/console.toml"]
LEAST = {"events": 60, "numbers": 1000}
# Open MPI needs two variables to run as root; on shared processors a waiting rank should yield to others.
os.environ |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
               "ASAN_OPTIONS": "detect_leaks=0"}
MECHANISM = """beam = { length = 1.0, elements = 1, EI = 1.0 }
contact = [{ node = 1, surface = "below", face = 0.0, stiffness = 10.0 }]
step = [{ point = [{ node = 2, w = -1.0 }] }]
"""


def mpirun(mpiexec, ranks):
    said = run(mpiexec, "--version").stdout
    more = ["--oversubscribe", "--bind-to", "none"] if "Open MPI" in said or "OpenRTE" in said else []
    return [mpiexec, *more, "-n", str(ranks)]


def events_of(step):
    """Returns (pair, change, share) of the step's events, sorted, because rounding decides the order of ties."""
    return sorted((e["pair"], e["change"], i["fraction"]) for i in step["increments"] for e in i["events"])


def difference(one, many, counts):
    """Returns the first difference between two results in words, or None."""
    for a, b in zip(one["steps"], many["steps"], strict=True):
        where = f"step {a['step']}"
        for (pair, change, share), (other, its_change, its_share) in zip(events_of(a), events_of(b), strict=True):
            if (pair, change) != (other, its_change) or abs(share - its_share) > 1e-9:
                return f"{where}: {change} {pair} at {share} and {its_change} {other} at {its_share}"
            counts["events"] += 1
        if [p["state"] for p in a["pairs"]] != [p["state"] for p in b["pairs"]]:
            return f"{where}: pairs have other states"
        allowed = a["error"]["w"] + b["error"]["w"]
        worst = max(abs(u - v) for u, v in zip(a["w"], b["w"], strict=True))
        if not worst <= allowed:
            return f"{where}: w is {worst:.2g} apart, allowed: {allowed:.2g}"
        counts["numbers"] += len(a["w"])
        if not (a["certificate"]["certified"] and b["certificate"]["certified"]):
            return f"{where}: certificates {a['certificate']} and {b['certificate']}"
    return None


def compare(contct, reference, job):
    counts = dict.fromkeys(LEAST, 0)
    with tempfile.TemporaryDirectory() as folder:
        for name in PROBLEMS:
            line = [contct, "run", reference / name, "--quiet", "--kernels", "corrected", "--engine"]
            many = result_of(*job, *line, "petsc", cwd=folder)
            if many["engine"] != "petsc":
                sys.exit(f"{name}: found the engine {many['engine']}")
            if found := difference(result_of(*line, "updated", cwd=folder), many, counts):
                sys.exit(f"{name}: {found}")
    if short := {k: n for k, n in counts.items() if n < LEAST[k]}:
        sys.exit(f"compared only {short}, required: {LEAST}")
    print(counts)


def ends(line, problem, status, words):
    """Checks the exit status, that `words` are on standard error once, and that the run leaves no file."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "p.toml").write_text(problem)
        finished = run(*line, "run", "p.toml", "--engine", "petsc", "--kernels", "corrected", cwd=folder)
        if (finished.returncode, finished.stderr.count(words)) != (status, 1):
            sys.exit(f"found exit status {finished.returncode}, allowed: {status}, with {words!r}\n{finished.stdout}{finished.stderr}")
        if (left := os.listdir(folder)) != ["p.toml"]:
            sys.exit(f"found {left}, allowed: no file but the problem")


def main():
    contct, reference = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    linked = run("ldd", contct, status=0).stdout
    if "lapack" not in linked or "libmpi" in linked or "petsc" in linked:
        sys.exit(f"found {linked}, allowed: no MPI and no PETSc")
    if len(sys.argv) == 3:
        ends([contct], MECHANISM, 2, "apt-get install libpetsc-real-dev")
        return
    job = mpirun(sys.argv[3], int(sys.argv[4]))
    compare(contct, reference, job)
    ends([*job, contct], MECHANISM.replace("EI", "IE"), 2, "p.toml:1")
    ends([*job, contct], MECHANISM, 4, "rigid-body motion")


main()
