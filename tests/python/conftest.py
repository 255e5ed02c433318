"""Fixtures for all tests of contct.py, which run with and without NumPy."""
import os
import sys
from pathlib import Path

import pytest

sys.path[:0] = [os.environ["CONTCT_BUILD"], str(Path(__file__).parents[1] / "support")]  # for contct.py and libcontct.so; for testing.py
from testing import ROOT, run  # noqa: E402

NUMPY = os.environ["CONTCT_TEST_NUMPY"]
if NUMPY == "hidden":
    sys.modules["numpy"] = None  # now `import numpy` raises ImportError

PROBLEMS = ROOT / "reference/problems"
sys.path += [str(ROOT / folder) for folder in ("tests/course", "reference", "reference/kernels")]  # for page, atlas, contct_kernel
import contct  # noqa: E402

assert (contct._numpy is not None) == (NUMPY == "there"), f"NumPy: found {contct._numpy}; allowed: {NUMPY}"


@pytest.fixture
def ask():
    """Runs the program: ask("run", FILE, ..) returns (exit status, standard output, standard error)."""
    def ask_contct(*arguments):
        done = run(f"{os.environ['CONTCT_BUILD']}/contct", *arguments)
        return done.returncode, done.stdout, done.stderr
    return ask_contct


def refusal(problem, function=contct.check, error=contct.InputError, **options):
    """Returns the exception that a function raises for a problem."""
    with pytest.raises(error) as caught:
        function(problem, **options)
    return caught.value


@pytest.fixture
def beam():
    """PB1 as a dict: a cantilever over a stop, in four steps."""
    return contct.read(PROBLEMS / "pb01-cantilever-tip-stop.toml")
