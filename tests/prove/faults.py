"""faults.py BUILD ROOT ID|all...: tests that the prover proves no kernel with a fault to be CONTCT.

The faults are those of tests/mutants/mutants.toml in the listing and in contct.hpp, and those of faults.toml.
`equivalent` kernels answer every call correctly, so they may be proved, but must not differ. Two faults are tried at
a time."""

import os
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

build, root = Path(sys.argv[1]), Path(sys.argv[2])
COMMANDS = {
    "fortran/contct.f": "gfortran -O2 -std=legacy -cpp -DCONTCT=CONTC8 -fdefault-real-8 -ffp-contract=off -fPIC -shared {} -o {}",
    "cpp/contct/kernel/contct.hpp": f"g++ -O2 -std=c++20 -ffp-contract=off -fPIC -shared -I {{}} -I {root}/cpp "
    f"{root}/cpp/contct/kernel/contct.cpp -o {{}}",
    "reference/kernels/contct_kernel.c": f"cc -O2 -ffp-contract=off -shared -fPIC -I {root}/cpp {{}} -o {{}}",
}
VERDICTS = {0: "proved", 1: "differs", 2: "undecided"}


def verdict_on(fault: dict, folder: Path) -> subprocess.CompletedProcess:
    """Builds a kernel with the fault, and runs the prover."""
    text = (root / fault["file"]).read_text()
    assert text.count(fault["find"]) == 1, f"{fault['id']}: found {text.count(fault['find'])} times; allowed: once"
    edited, library = folder / Path(fault["file"]).relative_to("cpp" if "cpp/" in fault["file"] else "."), folder / "faulty.so"
    edited.parent.mkdir(parents=True)
    edited.write_text(text.replace(fault["find"], fault["replace"]))
    command = COMMANDS[fault["file"]].format(folder if "cpp/" in fault["file"] else edited, library)
    subprocess.run(command.split(), check=True, cwd=folder)
    words = ["/usr/bin/python3", "-m", "contct_prove", str(library)]  # proves every kernel of the library
    return subprocess.run(words, env=os.environ | {"PYTHONPATH": str(build)}, capture_output=True, text=True)


def is_noticed(fault: dict) -> bool:
    """Prints the verdict on a fault, and returns True if it is allowed. Only plug-ins can be run against the listing to
    find a difference; other kernels stay undecided."""
    with tempfile.TemporaryDirectory() as name:
        said = verdict_on(fault, Path(name))
    equivalent = fault["id"] in own["equivalent"]
    allowed = (0, 2) if equivalent else (1,) if fault["id"] in own["differs"] else (2,)
    right = said.returncode in allowed and not said.stderr
    verdicts = [line.partition("): ")[2] for line in said.stdout.splitlines() if "): " in line]
    words = next((v for v in verdicts if not v.startswith("proved")), "")[:150]
    kind = "equivalent" if equivalent else "a fault"
    print("ok" if right else "FAILED", fault["id"], kind, VERDICTS.get(said.returncode), words, said.stderr, sep="; ", flush=True)
    return right


own = tomllib.loads((root / "tests/prove/faults.toml").read_text())
faults = [
    {"id": name, "file": source["file"], "find": find, "replace": replace}
    for source in tomllib.loads((root / "tests/mutants/mutants.toml").read_text())["source"] + own["source"]
    for name, find, replace in source["mutants"]
    if source["file"] in COMMANDS
]
asked = [f for f in faults if "all" in sys.argv[3:] or f["id"] in sys.argv[3:]]
with ThreadPoolExecutor(2) as pool:
    noticed = list(pool.map(is_noticed, asked))
print(f"{len(asked)} faults, {noticed.count(False)} failed")
sys.exit(0 if asked and all(noticed) else 1)
