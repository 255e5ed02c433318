"""Tests that results have the program's numbers, as attributes and items."""
import json
import pickle
import sys
from fractions import Fraction

import contct
import pytest
from conftest import PROBLEMS

@pytest.mark.parametrize("path", sorted(PROBLEMS.glob("p*-n4.toml")) + sorted(PROBLEMS.glob("pb0*.toml")), ids=lambda path: path.stem)
def test_contct_run_returns_the_numbers_of_the_programs_json_to_the_bit(path, ask):
    exit, out, _ = ask("run", path, "--quiet", "--json", "-")
    expected = json.loads(out)
    found = contct.run(path)
    assert found.to_dict() == expected  # Python reads and compares doubles exactly
    assert found.exit == exit
    assert len(found.steps) == len(expected["steps"]) >= 1
    # TOML text gives the same result, whether written by contct.read or read from the file.
    assert contct.run(contct.read(path)) == found
    assert contct.run(path.read_text()) == found


@pytest.mark.parametrize("name, rule", [("pb01-cantilever-tip-stop", "corrected"), ("divergences/near-tie", "1989")])
def test_contct_exact_returns_the_fractions_of_the_programs_json(name, rule, ask):
    path = PROBLEMS / f"{name}.toml"
    _, out, _ = ask("exact", path, "--rule", rule, "--json", "-", "--kernels", "fortran")
    found = contct.exact(path, rule=rule, kernels="fortran")
    assert found.to_dict() == json.loads(out)
    for step, raw in zip(found.steps, found.to_dict()["steps"]):
        assert [str(w) for w in step.w] == raw["w"]
        assert [str(u) for u in step.displacement] == raw["displacement"]
        assert [str(i.fraction) for i in step.increments] == [i["fraction"] for i in raw["increments"]]
        assert [(str(p.gap), str(p.force)) for p in step.pairs] == [(p["gap"], p["force"]) for p in raw["pairs"]]
        assert [str(r.value) for r in step.reactions] == [r["value"] for r in raw["reactions"]]


def test_a_hinge_has_its_rotation_and_moment():
    joint = contct.run(PROBLEMS / "pb18-rail-joint-over-void.toml").steps[0].hinges[0]
    assert (joint.hinge, joint.x) == (1, 3.0) and (joint.moment, joint.rotation) == pytest.approx((45, 0.01), rel=1e-12)


def test_contct_explain_returns_the_programs_json(ask):
    path = PROBLEMS / "pb07-three-gap-supports.toml"
    found = contct.explain(path)
    assert found.to_dict() == json.loads(ask("explain", path, "--quiet", "--json", "-")[1])
    one = contct.explain(path, step=2, increment=1)
    assert [(i.step, i.increment) for i in one.increments] == [(2, 1)]
    assert sorted(pair.why for pair in one.increments[0].pairs) == ["not toggled", "same moment", "winner"]


def test_keys_of_a_result_are_attributes_and_items(beam):
    found = contct.run(beam)
    step = found.steps[1]
    assert found.rule_1989.same_events and found.rule_1989.wrong_steps == [] and found.kernels == ["corrected", "fortran", "cpp"]
    assert step is found["steps"][1] and isinstance(step, contct.Record)
    assert step.pairs[0].force == step["pairs"][0]["force"] == found.to_dict()["steps"][1]["pairs"][0]["force"]
    assert step.certificate.certified is True
    assert step.error.w < 1e-15
    event = step.increments[0].events[0]
    assert (event.pair, event.node, event.surface, event.change) == (1, 3, "below", "make")
    assert set(step) == set(found.to_dict()["steps"][1]) and "w" in step and len(step) == len(set(step))
    assert {"w", "pairs", "to_dict"} <= set(dir(step))
    with pytest.raises(AttributeError, match='Record: found no "force"; allowed: step, name, fraction'):
        step.force
    with pytest.raises(KeyError):
        step["force"]


def test_arrays_of_a_result_are_numpy_arrays_or_without_numpy_lists(beam):
    result = contct.run(beam)
    step = result.steps[1]
    for x in (result.x, step.w, step.displacement, step.elements[0].moment):
        assert isinstance(x, contct._numpy.ndarray) and x.dtype == "float64" if contct._numpy else type(x) is list
    assert list(result.x) == [0.0, 1.0, 2.0] == list(contct.check(beam).x) and not hasattr(result, "y")
    assert list(step.w) == step.to_dict()["w"] and len(step.w) == 3
    assert step.extremes.w.min.value == min(step.w)  # "w" is an object here


def test_results_can_be_pickled_and_their_repr_is_one_short_line(beam):
    found = contct.run(beam)
    again = pickle.loads(pickle.dumps(found))
    assert again == found and again.exit == 0 and again.page == found.page and again != contct.run(beam, kernels="corrected")
    assert repr(found) == "<contct.Result 'PB1  Cantilever with a tip stop': solved, certified; 4 steps, 2 events>"
    assert repr(found.steps[0].increments[0]).startswith('<contct.Record {"increment": 1, "s": 1.0,') and len(repr(found.steps[0])) < 250
    assert "solved, NOT certified; 2 steps" in repr(contct.run(PROBLEMS / "divergences/near-tie.toml", kernels="fortran,cpp"))
    assert repr(contct.exact(beam)) == "<contct.Exact 'PB1  Cantilever with a tip stop': solved; 4 steps, 2 events>"
    assert len(contct.explain(beam).increments) == 6


def test_a_notebook_shows_the_report_page_of_a_result(beam, ask, tmp_path):
    found = contct.run(PROBLEMS / "pb01-cantilever-tip-stop.toml")
    shown = found._repr_html_()
    assert shown.startswith('<iframe srcdoc="') and shown.count('"') == 8  # no quote of the page ends the attribute
    assert found.page.startswith("<!DOCTYPE html>") or found.page.startswith("<!doctype html>")
    assert "Cantilever with a tip stop" in found.page
    assert found.page is found.page  # the page is made once
    assert contct.run(beam, final_only=True)._repr_html_() is None
    assert contct.certify(beam, found.steps[0].displacement)._repr_html_() is None


@pytest.mark.parametrize("problem, options, exit", [("pb07-three-gap-supports", [], 0), ("divergences/standstill", ["--kernels", "fortran,cpp"], 5)])
def test_contct_load_returns_the_result_of_a_file_in_the_format_of_today_and_in_the_first_one(problem, options, exit, ask, tmp_path):
    file = tmp_path / "result.json"
    assert ask("run", PROBLEMS / f"{problem}.toml", "--quiet", "--json", file, *options)[0] == exit
    result, old = json.loads(file.read_text()), json.loads(file.read_text())
    found = contct.load(file)
    assert (found.to_dict(), found.exit, found.messages) == (result, exit, result["warnings"])
    old["format"] = "contct-result-1"
    del old["quantities"]
    for step in old["steps"]:
        step["ended_by"] = "oracle"
        if step["certificate"]:
            step["certificate"]["exact"] = step["certificate"].pop("certified")
    file.write_text(json.dumps(old))
    found = contct.load(str(file))
    assert [step.certificate for step in found.steps] == [contct.Record(step["certificate"]) if step["certificate"] else None for step in result["steps"]]
    assert {step.ended_by for step in found.steps} == {"reference"} and "quantities" not in found and found.exit == exit
    for text, said in (('{"format": "contct-exact-1"}', "the format 'contct-exact-1'"), ("no JSON", "no format"), ("[]", "no format")):
        file.write_text(text)
        with pytest.raises(contct.InputError, match=f"result.json: found {said}; allowed: a result file"):
            contct.load(file)


def calls_of(trace):
    """Returns the lines of a trace without the title, which only the program writes, and without the date."""
    return [line for line in trace.splitlines() if not line.startswith(("about ", "contct-trace-1 "))]


def test_log_trace_and_proof_of_a_result_are_those_that_the_program_writes(ask, tmp_path):
    path = PROBLEMS / "pb07-three-gap-supports.toml"
    log, trace, proof = tmp_path / "log", tmp_path / "trace", tmp_path / "proof"
    assert ask("run", path, "--quiet", "--log", log, "--trace", trace, "--proof", proof)[0] == 0
    found = contct.run(path)
    assert found.log == log.read_text() and "MAKING CONTACT" in found.log
    assert calls_of(found.trace) == calls_of(trace.read_text())
    assert contct.replay(found.trace).calls == 8
    assert json.loads(found.proof) == json.loads(proof.read_text())
    assert "\nkernel cpp\n" in contct.run(path, kernels="cpp").trace  # options of this call only


def test_options_of_contct_run_act_as_options_of_the_program(beam, ask):
    path = PROBLEMS / "pb01-cantilever-tip-stop.toml"
    for options, arguments in (({"kernels": "corrected"}, ["--kernels", "corrected"]),
                               ({"kernels": ("cpp", "fortran"), "engine": "updated"}, ["--kernels", "cpp,fortran", "--engine", "updated"]),
                               ({"envelope": True}, ["--envelope"]), ({"final_only": True}, ["--final-only"]),
                               ({"kernels": "fortran", "max_increments": 1}, ["--kernels", "fortran", "--max-increments", "1"])):
        exit, out, _ = ask("run", path, "--quiet", "--json", "-", *arguments)
        found = contct.run(path, **options)
        assert (found.exit, found.to_dict()) == (exit, json.loads(out)), options
    assert exit == 5 and found.status == "iteration-limit" and not found.certified
    assert {"fortran", "cpp", "fortran-r4", "cpp-r4", "corrected"} <= {kernel.name for kernel in contct.about().kernels}
    assert "refactor" in contct.about().engines


def test_contct_certify_certifies_given_states_of_a_problem_and_refuses_a_wrong_state(beam):
    found = contct.run(beam)
    states = [step.displacement for step in found.steps]
    assert contct.certify(beam, states).certified is True
    assert contct.certify(beam, states[:1]).to_dict() == contct.certify(beam, states[0]).to_dict()
    if contct._numpy:
        assert contct.certify(beam, contct._numpy.array(states)) == contct.certify(beam, [list(u) for u in states])
    assert [step.pairs[0].state for step in contct.certify(beam, states).steps] == ["separated", "contact", "contact", "separated"]
    off = [list(states[0])]
    off[0][4] *= 1.01
    judged = contct.certify(beam, off)
    assert judged.certified is False and judged.exit == 3 and judged.messages
    assert contct.certify(beam, states[:2], closed=[[], []]).steps[1].pairs[0].state == "separated"
    assert contct.certify(beam, states[:2], closed=[[], [1]]).certified is True


def test_fractions_longer_than_pythons_limit_of_digits_are_read():
    p, q = 3**20001, 7**20000
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        text = f"-{p}/{q}"
    finally:
        sys.set_int_max_str_digits(limit)
    assert len(text) > 2 * limit
    assert contct.Record({"w": [text, "0", "-7", "15/28"]}, rational=True).w == [Fraction(-p, q), 0, -7, Fraction(15, 28)]


NAMED = {"beam": {"length": 4.0, "elements": 4, "section": {"E": 1e4, "I": 1.0, "W": 0.5}}, "support": [{"x": [0.0, 4.0], "fix": "w", "name": ["A", "B"]}],
         "contact": [{"x": 2.0, "surface": "below", "face": 0.0, "stiffness": 1e3, "name": "S"}],
         "bed": [{"from": 1.0, "to": 3.0, "modulus": 10.0, "face": 0.0}], "step": [{"uniform": -8.0}]}


def test_every_quantity_is_an_array_by_its_name():
    found = contct.run(NAMED)
    end, seen = found.steps[0], 0
    lengths = {"nodes": 5, "pairs": len(end.pairs), "supports": 2, "beds": 1, "element_ends": 4, "structure": 1}
    for row in found.quantities:
        values = found.array(row.key)
        assert len(values) == lengths[row.on], row.key
        seen += 1
    assert seen >= 14
    assert list(found.array("reaction")) == [r.value for r in end.reactions] and end.reactions[0].name == "A"
    assert list(found.array("force")) == [p.force for p in end.pairs] and end.pairs[0].name == "S"
    assert list(found.array("bed_pressure")) == [end.beds[0].pressure.max.value]
    assert list(found.array("moment")[1]) == list(end.elements[1].moment)
    assert found.array("sum_of_loads")[0] == pytest.approx(-32.0)
    with pytest.raises(contct.InputError, match="found quantity 'mx'; allowed: w, theta, "):
        found.array("mx")


def test_a_data_frame_has_a_column_for_each_quantity_of_a_list():
    pandas = pytest.importorskip("pandas")
    found = contct.run(NAMED)
    frame = found.to_dataframe("pairs")
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns)[-3:] == ["gap", "force", "face"]
    assert list(frame.index) == list(range(1, len(found.steps[0].pairs) + 1))
    assert list(frame["force"]) == [p.force for p in found.steps[0].pairs]
    assert list(found.to_dataframe("nodes")["x"]) == [node.x for node in found._with_structure().structure.nodes]
    assert len(found.to_dataframe("structure")) == 1
    of_matrix = contct.run([[2000.0, -1000.0], [-1000.0, 1000.0]], pairs=[{"dof": 1, "surface": "below", "face": -0.002, "stiffness": 1000.0}], loads=[0.0, -3.0])
    assert list(of_matrix.to_dataframe("nodes").columns) == ["dof", "w"] and len(of_matrix.to_dataframe("nodes")) == 2
    with pytest.raises(contct.InputError, match="found on='elements'; allowed: beds, "):
        found.to_dataframe("elements")


def test_refine_adds_the_changes_by_half_the_element_size():
    found = contct.run(NAMED, refine=True)
    assert 0 < found.refined.w.change < found.refined.w.of
    assert "refined" not in contct.run(NAMED)
