"""run.py BUILD LEAST numpy|hidden [ARGUMENT]..: pytest, with a floor on the tests that passed. BUILD has contct.py and
libcontct.so; "numpy": the module must have NumPy, "hidden": it must not, although it may be installed."""
import os
import sys
from pathlib import Path

import pytest


class Counter:
    def __init__(self):
        self.passed = 0

    def pytest_runtest_logreport(self, report):
        self.passed += report.when == "call" and report.passed


def main(build, least, numpy, *arguments):
    os.environ["CONTCT_BUILD"], os.environ["CONTCT_TEST_NUMPY"] = build, numpy
    sys.dont_write_bytecode = True
    here, counter = Path(__file__).parent, Counter()
    status = pytest.main(["-q", "-p", "no:cacheprovider", "-c", "/dev/null", "--rootdir", str(here), *(arguments or [str(here)])],
                         plugins=[counter])
    import contct
    if (contct._numpy is not None) != (numpy == "numpy"):
        return f"found {'NumPy' if contct._numpy else 'no NumPy'}; allowed: {numpy}"
    print(f"{counter.passed} tests passed")
    if counter.passed < int(least):
        return f"found {counter.passed} tests that passed; allowed: {least} or more"
    return int(status)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
