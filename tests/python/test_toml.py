"""Tests that dicts become TOML with exact numbers, and that values unknown to TOML are refused with their place."""
import array
import math
import random
import struct
import tomllib
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import contct
import pytest
from conftest import ROOT


def test_to_toml_writes_every_problem_of_the_project_without_a_change():
    files = sorted((ROOT / "reference").rglob("*.toml"))
    for path in files:
        with open(path, "rb") as file:
            problem = tomllib.load(file)
        assert tomllib.loads(contct.to_toml(problem)) == problem, path
    assert len(files) >= 60


def test_to_toml_keeps_the_bits_of_random_doubles():
    chosen = random.Random(1989)
    numbers = [x for x in (struct.unpack("<d", chosen.randbytes(8))[0] for _ in range(20000)) if math.isfinite(x)]
    numbers += [0.0, -0.0, 5e-324, 1.7976931348623157e308, 0.1, 1e16, 1e22, 1e-5, math.inf]
    again = tomllib.loads(contct.to_toml({"x": numbers}))["x"]
    assert struct.pack(f"{len(again)}d", *again) == struct.pack(f"{len(numbers)}d", *numbers)
    assert len(again) > 19000 and all(type(x) is float for x in again)
    assert math.isnan(tomllib.loads(contct.to_toml({"x": math.nan}))["x"])


def test_to_toml_keeps_whole_numbers_truth_values_texts_and_lists():
    problem = {"i": 3, "big": [-2**63, 2**63 - 1], "yes": True, "no": [False], "text": 'a "quoted" \\ \t\n\r\x01\x7f é \U0001f600',
               "empty": [], "none": {}, "in": {"a": {"b": [1, [2.5, "x"]], "c": {}}}, "odd key.é\n": 1, "": 2,
               "list": [{"a": 1}, {"b": {"c": [{"d": 1.0}]}}], "mixed": [{"a": 1}, 2]}
    again = tomllib.loads(contct.to_toml(problem))
    assert again == problem and type(again["i"]) is int and type(again["yes"]) is bool and type(again["no"][0]) is bool
    others = {"t": (1, 2), "r": range(3), "p": Path("K.mtx"), "a": array.array("d", [1.0, 2.0])}
    assert tomllib.loads(contct.to_toml(others)) == {"t": [1, 2], "r": [0, 1, 2], "p": "K.mtx", "a": [1.0, 2.0]}


def test_to_toml_writes_a_decimal_unchanged_and_contct_uses_the_shortest_decimal_of_its_double():
    assert contct.to_toml({"x": Decimal("0.1000000000000000000001")}) == "x = 0.1000000000000000000001\n"
    third = {"beam": {"x": [0, 1, 2], "EI": 1}, "support": [{"node": 1, "fix": ["w", "theta"]}],
             "step": [{"point": [{"node": 3, "w": Decimal("-0.100000000000000000000003")}]}]}
    exact = contct.exact(third)
    assert exact.steps[0].reactions[0].value == Fraction(1, 10)
    assert [m.partition("found")[2] for m in exact.messages] == [
        " -0.100000000000000000000003; the shortest decimal of its double, -0.1, is used everywhere"]


@pytest.mark.parametrize("value, words", [
    (None, "found None"), ({1}, "found a set"), (2**63, "found 9223372036854775808"), (1j, "found a complex"),
    (Decimal("nan"), r"found Decimal\('NaN'\)"), (b"x", "found a bytes"), (object(), "found a object"), (iter([1]), "found a list_iterator")])
def test_a_value_that_toml_does_not_have_is_refused_with_its_place(value, words):
    with pytest.raises(contct.InputError, match=rf"contact\[2\]\.face\[3\]: {words}; allowed: "):
        contct.run({"contact": [{"face": 1}, {"face": [0, 1, value]}]})
    with pytest.raises(contct.InputError, match="found the key 1; allowed: a text"):
        contct.to_toml({"beam": {1: 2}})


def test_to_toml_writes_numpy_numbers_and_arrays_as_numbers_and_lists():
    numpy = pytest.importorskip("numpy")
    if not contct._numpy:
        pytest.skip("NumPy is hidden")
    problem = {"a": numpy.float64(0.1), "b": numpy.float32(0.5), "c": numpy.int64(7), "d": numpy.bool_(True), "e": numpy.arange(3),
               "f": numpy.linspace(0, 1, 3), "g": numpy.array([[1.5, 2.5]]), "h": [numpy.float64(1.5)], "i": numpy.str_("x")}
    assert tomllib.loads(contct.to_toml(problem)) == {"a": 0.1, "b": 0.5, "c": 7, "d": True, "e": [0, 1, 2], "f": [0.0, 0.5, 1.0],
                                                      "g": [[1.5, 2.5]], "h": [1.5], "i": "x"}
    with pytest.raises(contct.InputError, match="x: found a complex"):
        contct.to_toml({"x": numpy.complex128(1)})
