"""hints.py BUILD.json [--write]: builds the mutants of the listing and of contct.hpp as shared libraries, and runs them
in the golden calls.

Every mutant whose numbers differ must have a separate sentence in reference/course/hints.toml, unless it is the C++
version of another mutant. Its answers must be those in the file, and hint.py must print its sentence. --write updates
the answers in the file.
"""
import json
import os
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutants import HERE, ROOT, UNMUTATED, edited, run_tool

sys.path.insert(0, str(ROOT / "reference/course/port"))
import hint  # noqa: E402

TABLE = ROOT / "reference/course/hints.toml"
LEAST = 50
WRAPPER = """
#include "contct/kernel/contct.hpp"
extern "C" void contct_kernel(const double* dd, const double* dtest, const double* cc, double* ss, double* smin, const int* id, int* isep,
                              const int* isurf, int nc, int indof, int ndofpn, int ndof) {
  std::vector<contct::event> events(4 * nc + 4096);
  const std::size_t n = nc, all = ndof;
  contct::call<double> c{{dd, all}, {dtest, all}, {cc, n}, {ss, n}, *smin, {id, n}, {isep, n}, {isurf, n}, {indof, ndofpn}};
  contct::contct(c, events);
  *smin = c.smin;
}
"""


def build_library(build, file, source, folder):
    copy = folder / file
    copy.parent.mkdir(parents=True)
    copy.write_text(source)
    common = ["-O1", "-ffp-contract=off", "-fPIC", "-shared", "-o", "kernel.so"]
    if copy.suffix == ".f":
        run_tool([build["fortran"], *build["fortran_flags"].split(), "-std=legacy", "-fdefault-real-8", *common, copy], folder)
    else:
        (folder / "wrapper.cpp").write_text(WRAPPER)
        run_tool([build["cxx"], *build["cxx_flags"].split(), "-std=c++20", "-I", folder / "cpp", "-I", ROOT / "cpp", *common, "wrapper.cpp"], folder)


def found_of(build, file, replacements, calls):
    """Returns the entries of hints.toml for a mutant's answers, and the quantity of the first difference."""
    with tempfile.TemporaryDirectory() as folder:
        build_library(build, file, edited((ROOT / file).read_text(), replacements), Path(folder))
        found, first = hint.findings(calls, hint.answers_of(f"plugin:{folder}/kernel.so", calls))
    return found, first and first[1][0]


def as_text(table):
    head = "".join(line for line in TABLE.read_text().splitlines(keepends=True) if line.startswith("#"))
    return head + "".join(f"{name} = {{ says = {json.dumps(t['says'])}, right = {t['right']}, first = \"{t['first']}\", digest = \"{t['digest']}\" }}\n"
                          for name, t in table.items())


def main(scratch, build_file, write=False):
    os.chdir(scratch)  # the mutants write unit 26 to the current folder
    build, table, calls = json.loads(Path(build_file).read_text()), hint.read_table(), hint.golden_calls()
    sources = [s for s in tomllib.loads((HERE / "mutants.toml").read_text())["source"] if s["file"].endswith((".f", "contct.hpp"))]
    trials = [(s["file"], name, edits) for s in sources for name, edits in
              [(UNMUTATED, []), *((name, [(old, new)]) for name, old, new in s["mutants"] if not name.startswith("write-"))]]
    with ThreadPoolExecutor(2) as workers:
        results = list(workers.map(lambda t: found_of(build, t[0], t[2], calls), trials))
    wrong, seen = [], {}
    for (file, name, _), (found, quantity) in zip(trials, results):
        key = f"cpp-{name}" if file.endswith(".hpp") else name
        if file.endswith(".hpp") and found["digest"] in {t["digest"] for t in seen.values()}:
            continue  # the C++ kernel has the same fault as the listing
        if quantity is None:
            wrong += [f"{key}: it has a sentence, but its numbers are right"] * (key in table)
            continue
        if name == UNMUTATED:
            wrong.append(f"{file} as it is gives other answers: {found}")
        elif write:
            seen[key] = {"says": table.get(key, {}).get("says", ""), **found}
        elif {**found, "says": table.get(key, {}).get("says")} != table.get(key):
            wrong.append(f"{key}: found {found}; the file has {table.get(key)}")
        else:
            seen[key] = table[key]
            worth, sentences = hint.hints(found, quantity, table)
            if table[key]["says"] not in sentences or not worth.startswith("All"):
                wrong.append(f"{key}: hint.py says {sentences}; allowed: {table[key]['says']}")
    if write:
        TABLE.write_text(as_text(seen | {key: t for key, t in table.items() if key.startswith("port-")}))  # tests/course/port.py tests these
    says = [t["says"] for t in seen.values()]
    wrong += [f"the same sentence stands twice, or is empty: {s}" for s in set(says) if says.count(s) > 1 or not s]
    wrong += [f"{len(seen)} mutants have a sentence; allowed: {LEAST} or more"] * (len(seen) < LEAST)
    print("\n".join([*wrong, f"{len(trials)} kernels, {len(seen)} whose numbers differ, {len(set(t['digest'] for t in seen.values()))} different answers"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        status = main(scratch, str(Path(sys.argv[1]).resolve()), *sys.argv[2:])
        os.chdir("/")
    sys.exit(status)
