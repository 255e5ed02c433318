"""Fixtures for all tests of contct.py, which run with and without NumPy."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

NUMPY = os.environ["CONTCT_TEST_NUMPY"]
if NUMPY == "hidden":
    sys.modules["numpy"] = None  # now `import numpy` raises ImportError

ROOT = Path(__file__).resolve().parents[2]
PROBLEMS = ROOT / "reference/problems"
sys.path.insert(0, os.environ["CONTCT_BUILD"])  # for contct.py and libcontct.so
sys.path.append(str(ROOT / "tests/course"))  # for page.py
import contct  # noqa: E402

assert (contct._numpy is not None) == (NUMPY == "there"), f"NumPy: found {contct._numpy}; allowed: {NUMPY}"


@pytest.fixture
def ask():
    """Runs the program: ask("run", FILE, ..) returns (exit status, standard output, standard error)."""
    def run(*arguments):
        finished = subprocess.run([os.environ["CONTCT_BUILD"] + "/contct", *map(str, arguments)], capture_output=True, text=True)
        return finished.returncode, finished.stdout, finished.stderr
    return run


@pytest.fixture
def beam():
    """PB1 as a dict: a cantilever over a stop, in four steps."""
    return contct.read(PROBLEMS / "pb01-cantilever-tip-stop.toml")
