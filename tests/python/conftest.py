"""What all tests of contct.py have: the module, with NumPy or without, the project's root and the program."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

if os.environ.get("CONTCT_TEST_NUMPY") == "hidden":
    sys.modules["numpy"] = None  # import numpy raises ImportError

ROOT = Path(__file__).resolve().parents[2]
PROBLEMS = ROOT / "reference/problems"
sys.path.insert(0, os.environ["CONTCT_BUILD"])  # contct.py and libcontct.so
sys.path.append(str(ROOT / "tests/course"))  # page.py


@pytest.fixture
def ask():
    """The program: ask("run", FILE, ..) is (exit status, standard output, standard error)."""
    def run(*arguments):
        finished = subprocess.run([os.environ["CONTCT_BUILD"] + "/contct", *map(str, arguments)], capture_output=True, text=True)
        return finished.returncode, finished.stdout, finished.stderr
    return run


@pytest.fixture
def beam():
    """PB1 as a dict: a cantilever over a stop, four steps."""
    import contct
    return contct.read(PROBLEMS / "pb01-cantilever-tip-stop.toml")


def pytest_report_header():
    import contct
    return f"contct.py: {contct.__file__}, NumPy: {contct._numpy and contct._numpy.__version__}"
