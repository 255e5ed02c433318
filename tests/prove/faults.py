"""faults.py BUILD ROOT ID|all...: no fault put into a kernel on purpose is proved to be CONTCT.

The faults are those of tests/mutants/mutants.toml in the listing and in contct.hpp, and of faults.toml here. `equivalent`
ones answer every call as they should: they may be proved, and must not differ."""

import os
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

build, root = Path(sys.argv[1]), Path(sys.argv[2])
COMMANDS = {
    "fortran/contct.f": "gfortran -O3 -std=legacy -cpp -DCONTCT=CONTC8 -fdefault-real-8 -ffp-contract=off -fPIC -shared {} -o {}",
    "cpp/contct/kernel/contct.hpp": f"g++ -O3 -std=c++20 -ffp-contract=off -fPIC -shared -I {{}} -I {root}/cpp "
    f"{root}/cpp/contct/kernel/contct.cpp -o {{}}",
    "reference/kernels/contct_kernel.c": f"cc -O2 -ffp-contract=off -shared -fPIC -I {root}/cpp {{}} -o {{}}",
}


def verdict_on(fault: dict, folder: Path) -> subprocess.CompletedProcess:
    """What the prover says of a kernel with the fault."""
    text = (root / fault["file"]).read_text()
    find, replace = fault["find"].strip("\n"), fault["replace"].strip("\n")
    if text.count(find) != 1:
        sys.exit(f"{fault['id']}: found {text.count(find)} times in {fault['file']}; allowed: once")
    edited, library = folder / Path(fault["file"]).relative_to("cpp" if "cpp/" in fault["file"] else "."), folder / "faulty.so"
    edited.parent.mkdir(parents=True)
    edited.write_text(text.replace(find, replace))
    command = COMMANDS[fault["file"]].format(folder if "cpp/" in fault["file"] else edited, library)
    subprocess.run(command.split(), check=True, cwd=folder)
    words = ["/usr/bin/python3", "-m", "contct_prove", str(library)]  # every kernel in it, in both precisions of C++
    return subprocess.run(words, env=os.environ | {"PYTHONPATH": str(build)}, capture_output=True, text=True)


faults = [
    {"id": name, "file": source["file"], "find": find, "replace": replace}
    for source in tomllib.loads((root / "tests/mutants/mutants.toml").read_text())["source"]
    for name, find, replace in source["mutants"]
    if source["file"] in COMMANDS
]
faults += tomllib.loads((root / "tests/prove/faults.toml").read_text())["mutant"]
asked = [f for f in faults if "all" in sys.argv[3:] or f["id"] in sys.argv[3:]]
failed = 0
for fault in asked:
    with tempfile.TemporaryDirectory() as name:
        said = verdict_on(fault, Path(name))
    equivalent = "equivalent" in fault
    allowed = (0, 2) if equivalent else (1,) if fault.get("differs") else (2,)  # only a plug-in can be run beside the listing
    wrong = said.returncode not in allowed or bool(said.stderr)
    failed += wrong
    outcome = {0: "proved", 1: "differs", 2: "undecided"}.get(said.returncode, said.stderr)
    verdicts = [line for line in said.stdout.splitlines() if ": " in line]
    words = next((v for v in verdicts if ": proved" not in v), "")[-150:]
    print("FAILED" if wrong else "ok", fault["id"], "equivalent" if equivalent else "a fault", outcome, words, sep="; ", flush=True)
print(f"{len(asked)} faults, {failed} failed")
sys.exit(1 if failed or not asked else 0)
