"""Tests that bad input raises an exception with its place, and that other ends are results or, on request,
exceptions."""
import os
import re

import contct
import pytest
from conftest import PROBLEMS, refusal


def test_an_error_in_a_problem_file_has_file_line_and_column(tmp_path, monkeypatch):
    text = (PROBLEMS / "pb01-cantilever-tip-stop.toml").read_text()
    line = text.split("\n").index("stiffness = 5.0e4") + 1
    bad = tmp_path / "bad.toml"
    bad.write_text(text.replace("stiffness = 5.0e4", "stiffness = -5.0e4"))
    for function in (contct.run, contct.check, contct.exact, contct.explain):
        error = refusal(bad, function)
        assert (error.file, error.line, error.column) == (str(bad), line, 13)
        assert error.message.startswith("contact[1].stiffness: found -50000") and "allowed: " in error.message
        assert str(error) == f"{bad}:{line}:13: {error.message}"
        assert not hasattr(error, "__notes__")  # no note, because the file exists
    assert isinstance(error, ValueError) and isinstance(error, contct.Error)
    monkeypatch.chdir(tmp_path)
    assert refusal("bad.toml").file == "bad.toml"
    bad.write_text("a = 1\nb = ?\n")
    error = refusal(bad, contct.read)
    assert (error.file, error.line, error.column) == (str(bad), 2, 5)


def test_an_error_in_a_problem_given_as_a_dict_or_as_text_has_line_and_column(beam):
    beam["contact"][0]["face"] = "low"
    error = refusal(beam)
    assert (error.file, error.column) == ("problem", 8) and contct.to_toml(beam).split("\n")[error.line - 1] == 'face = "low"'
    assert error.__notes__ == [f'line {error.line} of problem: face = "low"']
    for text, line, column, words in (("[beam]\nx = 3\n", 2, 5, "beam.x: found 3; allowed: an array of at least 2 numbers, each a finite number"),
                                      ("a = 1\nb = 'x\0y'\n", 2, 7, "code 0"), ("[beam\n", 1, 6, ""), ("a = 1\nb = '\ud800'\n", 2, None, "")):  # a surrogate is not valid UTF-8
        error = refusal(text)
        assert (error.file, error.line) == ("problem", line) and error.column == (column or error.column) and words in error.message


def test_run_and_check_refuse_an_argument_that_is_not_a_problem():
    assert "found 'beam'; allowed: a path or a name that ends in \".toml\"" in refusal("beam").message
    assert refusal("").line is None
    for nothing in (None, 3, ["a"], b"[beam]\n"):
        assert re.match("problem: found a .*; allowed: a path or a name", str(refusal(nothing, contct.run, TypeError)))
    for function in (contct.run, contct.read):
        refusal("no-such-file.toml", function, FileNotFoundError)


def test_wrong_options_of_run_and_wrong_states_of_certify_are_refused(beam):
    assert refusal(beam, contct.run, engine="steam").message.startswith('options: engine: found "steam"; allowed: auto, ')
    with pytest.raises(TypeError, match="found a set as an option"):
        contct.run(beam, max_increments={1})
    if contct._numpy:
        assert contct.run(beam, kernels="fortran", max_increments=contct._numpy.int64(1)).exit == 5
    assert "found nan in state 1, dof 2" in refusal(beam, lambda p: contct.certify(p, [0.0, float("nan"), 0, 0, 0, 0])).message


MECHANISM = ("[beam]\nx = [0.0, 1.0]\nEI = 1.0\n[[support]]\nnode = 1\nfix = \"w\"\n[[contact]]\nnode = 2\nsurface = \"below\"\nface = 0.0\n"
             "stiffness = 1.0\n[[step]]\npoint = [ { node = 2, w = 1.0 } ]\n")


def test_run_with_strict_raises_an_exception_unless_the_result_is_solved_and_certified(beam):
    assert contct.run(beam, strict=True).certified
    for problem, options, exit, words in ((MECHANISM, {}, 4, "mechanism"), (beam, {"kernels": "fortran", "max_increments": 1}, 5, "iteration-limit"),
                                          (PROBLEMS / "divergences/near-tie.toml", {"kernels": "fortran,cpp"}, 3, "NOT certified")):
        with pytest.raises(contct.NotSolved, match=words) as caught:
            contct.run(problem, strict=True, **options)
        assert caught.value.exit == exit and caught.value.result == contct.run(problem, **options)
        assert caught.value.result.messages[0] in str(caught.value)
    assert contct.run(PROBLEMS / "divergences/near-tie.toml", strict=True).certified
    assert contct.exact(MECHANISM).exit == 4 and "no equilibrium" in contct.run(MECHANISM).messages[-1]


def of_matrix(folder, name):
    """Writes K.mtx into the folder, and returns a problem with the matrix file `name`."""
    (folder / "K.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2.0\n2 1 -1.0\n2 2 2.0\n")
    return {"matrix": {"stiffness": name}, "contact": [{"dof": "2", "surface": "above", "face": 0.5, "stiffness": 10.0}],
            "step": [{"point": [{"dof": "1", "value": 3.0}]}]}


def test_files_that_a_problem_names_are_beside_its_file_or_in_the_given_folder(tmp_path, monkeypatch):
    problem = of_matrix(tmp_path, "K.mtx")
    (tmp_path / "p.toml").write_text(contct.to_toml(problem))
    found = contct.run(tmp_path / "p.toml")
    assert found.certified and [pair.state for pair in found.steps[0].pairs] == ["contact"]
    assert contct.run(problem, folder=tmp_path) == contct.run(problem, folder=str(tmp_path)) == found
    assert os.getcwd() != str(tmp_path) and "K.mtx" in str(refusal(problem, contct.run))
    monkeypatch.chdir(tmp_path)
    assert contct.run(problem) == found
    (tmp_path / "K.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2.0\n2 1 x\n2 2 2.0\n")
    assert "K.mtx" in refusal(tmp_path / "p.toml", contct.run).file


def test_a_problem_may_name_a_file_outside_its_folder_only_with_allow_outside(tmp_path):
    (tmp_path / "own").mkdir()
    problem = of_matrix(tmp_path, "../K.mtx")
    with pytest.raises(contct.InputError, match="not below the folder of the problem file.*allow_outside"):
        contct.run(problem, folder=tmp_path / "own")
    assert contct.run(problem, folder=tmp_path / "own", allow_outside=True).page.startswith("<!DOCTYPE html>")  # a second run
