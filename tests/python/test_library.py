"""Tests where contct.py searches its library, and the message if the library is not found."""
import os
import shutil
import sys

import pytest
from testing import run

BUILD = os.environ["CONTCT_BUILD"]


def imported(folder, program="import contct; print(contct._library._name)", **environment):
    """Returns (exit status, output, errors) of a Python process that imports contct.py from the folder."""
    done = run(sys.executable, "-B", "-c", program, env={"PYTHONPATH": str(folder), "PATH": os.environ["PATH"], **environment})
    return done.returncode, done.stdout.strip(), done.stderr


@pytest.fixture
def alone(tmp_path):
    """A folder with contct.py and without its library."""
    shutil.copy(os.path.join(BUILD, "contct.py"), tmp_path)
    return tmp_path


def test_the_library_is_searched_beside_the_module_then_by_contct_library_then_in_the_system(alone, tmp_path):
    library, there = os.path.join(BUILD, "libcontct.so"), tmp_path / "lib"
    assert imported(BUILD, CONTCT_LIBRARY="/no/such/library.so")[:2] == (0, os.path.realpath(BUILD) + "/libcontct.so")
    assert imported(alone, CONTCT_LIBRARY=library)[:2] == (0, library)
    there.mkdir()
    os.symlink(library, there / "libcontct.so.0")
    status, name, errors = imported(alone, LD_LIBRARY_PATH=str(there))
    assert status == 0 and "libcontct" in name, errors
    os.symlink(library, alone / "libcontct.so.0")
    assert imported(alone)[:2] == (0, str(alone / "libcontct.so.0"))


def test_without_a_library_the_import_error_says_what_to_do(alone):
    status, _, errors = imported(alone)
    if status == 0:
        pytest.skip("the system has a libcontct.so.0")
    assert "ImportError: contct.py: libcontct.so.0: cannot open shared object file" in errors
    assert f"next to {alone / 'contct.py'}" in errors and "CONTCT_LIBRARY=" in errors and "sh cpp/run.sh" in errors
    assert "ImportError: contct.py: /no/such.so" in imported(alone, CONTCT_LIBRARY="/no/such.so")[2]


def test_a_library_with_another_interface_is_refused(alone):
    if not shutil.which("cc"):
        pytest.skip("there is no C compiler")
    library = alone / "libcontct.so"
    for source, words in (("int contct_serve_version(void) { return 2; }", f"{library} has interface 2; allowed: 1"),
                          ("int nothing;", "contct_serve_version")):
        (alone / "other.c").write_text(source)
        run("cc", "-shared", "-fPIC", "-o", library, alone / "other.c", status=0)
        assert "ImportError: contct.py: " in (said := imported(alone)[2]) and words in said
