"""Tests single calls of kernels, kernels in Python, and recorded calls."""
import array
import json
import sys
from concurrent.futures import ThreadPoolExecutor

import contct
import contct_kernel
import pytest
from conftest import PROBLEMS, ROOT, refusal

LAYOUT = dict(dd=[0.0, 9.0, 0.0, 9.0], dtest=[2.0, 0.0, 1.0, 0.0], cc=[0.5, 0.75], id=[1, 2], isep=[1, 1], isurf=[1, 1], ndofpn=2)


def test_contct_call_returns_the_answer_of_a_kernel_to_one_call():
    isep = [1, 1]
    found = contct.call("fortran", [0, 0], [2, 1], [0.5, 0.75], [1, 2], isep, [1, 1])
    assert (list(found.ss), found.smin, list(found.isep)) == ([0.25, 0.75], 0.25, [-1, 1])
    assert isep == [1, 1]  # the arguments are unchanged
    assert "MAKING CONTACT" in found.text and "0.2500E+00" in found.text
    none = contct.call("cpp-r4", [], [], [], [], [], [])
    assert (list(none.ss), none.smin, list(none.isep)) == ([], 1.0, [])


def test_contct_call_accepts_tuples_lists_arrays_and_numpy_arrays():
    expected = contct.call("fortran", **LAYOUT)
    kinds = [tuple, list, lambda x: array.array("d" if isinstance(x[0], float) else "i", x)]
    for kind in kinds + ([contct._numpy.array] if contct._numpy else []):
        found = contct.call("fortran", *(kind(LAYOUT[name]) for name in ("dd", "dtest", "cc", "id", "isep", "isurf")), 1, 2)
        assert list(found.ss) == list(expected.ss) and found.text == expected.text
    if contct._numpy:
        assert isinstance(expected.ss, contct._numpy.ndarray) and expected.isep.tolist() == [-1, 1]
        for wrong in ([[1, 2]], [1.0, 2.0]):
            with pytest.raises(TypeError, match="id: .*; allowed: a list or an array of whole numbers"):
                contct.call("fortran", [0, 0], [2, 1], [0.5, 0.75], contct._numpy.array(wrong), [1, 1], [1, 1])


@pytest.mark.parametrize("change, error, words", [
    ({"dtest": [1.0]}, contct.InputError, "dtest: found 1 value; allowed: 4"), ({"isep": [1]}, contct.InputError, "isep: found 1 value; allowed: 2"),
    ({"id": [1, 2**40]}, contct.InputError, "id: .*; allowed: whole numbers of 32 bits"), ({"id": [1, 1.5]}, TypeError, "id: .*float"),
    ({"dd": ["a", 1, 1, 1]}, TypeError, "dd: "), ({"cc": 3}, TypeError, "cc: "),
    ({"indof": 3}, contct.InputError, "pair 2: found ID 2, which is dof 5 with INDOF 3 and NDOFPN 2; allowed: a dof from 1 to 4")])
def test_contct_call_refuses_arrays_of_wrong_length_or_type(change, error, words):
    with pytest.raises(error, match=words):
        contct.call(**{"kernel": "fortran", **LAYOUT, **change})


def listing(call):
    """Answers a call by reference/kernels/contct_kernel.py."""
    smin, ss, isep = contct_kernel.contct([(call.dd[dof], call.dtest[dof], *pair) for dof, *pair in zip(call.dofs, call.cc, call.isep, call.isurf)])
    return ss, smin, isep


def test_contct_judge_finds_a_right_kernel_equal_to_the_bit():
    found = contct.judge(listing, calls=2000, problems=5)
    assert found.equal and found.exit == 0 and found.mismatches == 0 and found.level == "bits" and found.findings == []
    assert found.values_compared > 30000 and found.kernels == ["fortran", "listing"] and found.seed == 1989
    assert "'listing': equal to the bit" in repr(found)
    if contct._numpy:
        arrays = contct.judge(lambda call: tuple(map(contct._numpy.array, listing(call))), calls=1000, problems=1)
        assert arrays.equal and arrays.values_compared > 10000


def test_contct_judge_gives_the_numbers_of_contct_fuzz(ask):
    exit, out, _ = ask("fuzz", "--calls", 1000, "--problems", 2, "--seed", 7, "--json", "-", "--quiet", "--kernels",
                       f"fortran,pipe:{sys.executable} {ROOT}/reference/kernels/contct_kernel.py")
    expected, found = json.loads(out), contct.judge(listing, calls=1000, problems=2, seed=7).to_dict()
    assert exit == 0 and expected["values_compared"] > 10000
    for report in (expected, found):
        del report["seconds"], report["kernels"], report["followers"][0]["kernel"]
    assert found == expected


def test_contct_judge_detects_a_kernel_with_a_fault(monkeypatch):
    monkeypatch.setattr(contct_kernel, "EPSMUL", 0.4e-02)
    found = contct.judge(listing, calls=2000, problems=5, name="wrong")
    assert not found.equal and found.exit == 1 and found.mismatches > 0 and found.level in ("none", "certificate", "events")
    assert "wrong differs in" in found.findings[0] and "NOT equal" in repr(found)


def test_contct_judge_and_contct_run_work_in_several_threads_at_once(beam):
    expected = contct.run(beam)
    with ThreadPoolExecutor(3) as pool:
        judged = [pool.submit(contct.judge, listing, calls=1000, problems=1) for _ in range(2)]
        runs = [pool.submit(contct.run, beam) for _ in range(20)]
        assert all(j.result().equal for j in judged) and all(r.result() == expected for r in runs)


def test_contct_judge_raises_the_exception_of_a_kernel_with_a_note_about_the_call():
    seen = []

    def fails(call):
        seen.append(call)
        if len(seen) == 100:
            raise ZeroDivisionError("the hundredth")
        return listing(call)

    error = refusal(fails, contct.judge, ZeroDivisionError, calls=2000)
    assert str(error) == "the hundredth" and len(seen) == 100  # the kernel is not called again
    assert error.__notes__[0].startswith(f"in a call of {len(seen[-1].id)} pair")

    def stops(call):
        raise KeyboardInterrupt

    refusal(stops, contct.judge, KeyboardInterrupt, calls=2000)
    assert contct.judge(listing, calls=1000, problems=1).equal


@pytest.mark.parametrize("answer, error, words", [
    (None, TypeError, "found None; allowed: .ss, smin, isep"), (([], 1.0, []), contct.InputError, "found 0 values of ss and 0 of isep"),
    (("x", 1.0, []), TypeError, "allowed: .ss, smin, isep")])
def test_contct_judge_refuses_an_answer_of_wrong_type_or_length(answer, error, words):
    with pytest.raises(error, match=words):
        contct.judge(lambda call: answer, calls=100, problems=1)


def test_contct_replay_compares_a_kernel_with_a_trace_and_refuses_a_malformed_trace(ask):
    path = ROOT / "reference/traces/ties.trace"
    found = contct.replay(path, kernel="cpp")
    assert found.calls > 5 and found.values_compared > 30 and found.mismatches == 0 and found.first is None
    assert contct.replay(str(path)) == contct.replay(path.read_text(), kernel="fortran")
    own = contct.run(PROBLEMS / "pb01-cantilever-tip-stop.toml").trace
    assert contct.replay(own).calls == 6
    doctored = contct.replay(own.replace(" isep -1", " isep 1", 1))
    assert doctored.mismatches >= 1 and doctored.first
    error = refusal(own.replace("smin", "smax", 1), contct.replay)
    assert error.file == "trace" and error.line > 1
    refusal({}, contct.replay, TypeError)
