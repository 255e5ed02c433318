"""faults.py BUILD ROOT ID|all...: tests that the prover proves no kernel with a fault to be CONTCT.

The faults are those of tests/mutants/mutants.toml in the listing and in contct.hpp, and those of faults.toml.
`equivalent` kernels answer every call correctly, so they may be proved, but must not differ. Two faults are tried at
a time."""

import os
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

build, root = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(root / "tests/support"))
from edits import edited
from testing import run

COMMANDS = {
    "fortran/contct.f": "gfortran -O2 -std=legacy -cpp -DCONTCT=CONTC8 -fdefault-real-8 -ffp-contract=off -fPIC -shared fortran/contct.f",
    "cpp/contct/kernel/contct.hpp": f"g++ -O2 -std=c++20 -ffp-contract=off -fPIC -shared -I cpp -I {root}/cpp {root}/cpp/contct/kernel/contct.cpp",
    "reference/kernels/contct_kernel.c": f"cc -O2 -ffp-contract=off -shared -fPIC -I {root}/cpp reference/kernels/contct_kernel.c",
}
CPP = "_ZN6contct6contctI{}EEiRNS_4callIT_EESt4spanINS_5eventELm18446744073709551615EE"
SYMBOLS = {"fortran/contct.f": ["contc8_"], "cpp/contct/kernel/contct.hpp": [CPP.format("d"), CPP.format("f")],
           "reference/kernels/contct_kernel.c": ["contct_kernel"]}  # fmt: skip
VERDICTS = {0: "proved", 1: "differs", 2: "undecided"}


def is_noticed(fault: tuple[str, str, str, str]) -> bool:
    """Builds a kernel with a fault, prints the verdict of the prover, and returns True if it is allowed. Only plug-ins can
    be run against the listing to find a difference; other kernels stay undecided."""
    name, file, find, replace = fault
    with tempfile.TemporaryDirectory() as scratch:
        copy = Path(scratch, file)
        copy.parent.mkdir(parents=True)
        copy.write_text(edited((root / file).read_text(), [(find, replace)]))
        run(*COMMANDS[file].split(), "-o", "faulty.so", cwd=scratch, status=0)
        for symbol in SYMBOLS[file]:  # a fault may be in one precision only
            said = run("/usr/bin/python3", "-m", "contct_prove", "faulty.so", "--symbol", symbol, cwd=scratch, env=os.environ | {"PYTHONPATH": str(build)})
            if said.returncode:
                break
    equivalent = name in own["equivalent"]
    allowed = (0, 2) if equivalent else (1,) if name in own["differs"] else (2,)
    right = said.returncode in allowed and not said.stderr
    verdicts = [line.partition("): ")[2] for line in said.stdout.splitlines() if "): " in line]
    words = next((v for v in verdicts if not v.startswith("proved")), "")[:150]
    print("ok" if right else "FAILED", name, "equivalent" if equivalent else "a fault", VERDICTS.get(said.returncode), words, said.stderr, sep="; ", flush=True)
    return right


own = tomllib.loads((root / "tests/prove/faults.toml").read_text())
asked = [(name, source["file"], find, replace) for source in tomllib.loads((root / "tests/mutants/mutants.toml").read_text())["source"] + own["source"]
         for name, find, replace in source["mutants"] if source["file"] in COMMANDS and {"all", name} & set(sys.argv[3:])]  # fmt: skip
with ThreadPoolExecutor(2) as pool:
    noticed = list(pool.map(is_noticed, asked))
print(f"{len(asked)} faults, {noticed.count(False)} failed")
sys.exit(0 if asked and all(noticed) else 1)
