"""Tests the lines that Result.plot gives to matplotlib against closed forms."""
import pickle
import sys

import contct
import pytest

L, EI, q = 6.0, 1000.0, -12.0


@pytest.fixture
def simple():
    """Returns a beam of two elements on two supports under a uniform load, with a stop that it does not reach."""
    return {"title": "simple", "units": {"length": "m", "force": "kN"},
            "beam": {"length": L, "elements": 2, "EI": EI}, "support": [{"nodes": [1, 3], "fix": "w"}],
            "contact": [{"node": 2, "surface": "below", "face": -0.3, "stiffness": 1e4}],
            "step": [{"name": "half", "uniform": q / 2}, {"uniform": q}]}


def plotted(problem, quantity="w", **options):
    """Returns {label: (x, y)} of the lines that are drawn."""
    axes = contct.run(problem, kernels="corrected").plot(quantity, **options)
    return {line.get_label(): (list(line.get_xdata()), list(line.get_ydata())) for line in axes.lines}


@pytest.fixture
def matplotlib():
    found = pytest.importorskip("matplotlib")
    found.use("Agg")
    yield found
    sys.modules["matplotlib.pyplot"].close("all")


def test_the_curves_of_a_beam_are_exact_between_nodes(simple, matplotlib):
    closed_forms = {"w": lambda x: q * x * (L**3 - 2 * L * x**2 + x**3) / (24 * EI), "moment": lambda x: -q * x * (L - x) / 2,
                    "shear": lambda x: -q * (L / 2 - x)}
    for quantity, formula in closed_forms.items():
        xs, ys = plotted(simple, quantity)[quantity]
        assert len(xs) > 400 and xs[0] == 0 and xs[-1] == L
        assert ys == pytest.approx([formula(x) for x in xs], abs=1e-9)
    assert contct.run(simple).plot().get_ylabel() == "w [m]"


def test_the_curves_of_a_beam_have_kinks_at_a_load_inside_an_element_and_at_a_hinge(matplotlib):
    beam = {"beam": {"length": 10.0, "elements": 2, "EI": EI}, "hinge": [{"node": 2}],
            "support": [{"node": 1, "fix": ["w", "theta"]}, {"node": 3, "fix": "w"}], "step": [{"point": [{"x": 7.5, "w": -8.0}]}]}
    xs, ys = plotted(beam, "moment")["moment"]  # the right part is a simple beam hung from the left part
    assert all(abs(m - (-4 * (5 - x) if x <= 5 else 4 * (x - 5) if x <= 7.5 else 4 * (10 - x))) < 1e-9 for x, m in zip(xs, ys))
    xs, ys = plotted(beam)["w"]
    assert all(abs(w + 4 * x * x * (15 - x) / (6 * EI)) < 1e-9 for x, w in zip(xs, ys) if x <= 5)
    assert {round(v, 9) for v in plotted(beam, "shear")["shear"][1]} == {4.0, -4.0}


def test_plot_draws_the_step_with_the_given_index(simple, matplotlib):
    axes = contct.run(simple, kernels="corrected").plot("moment", step=0)
    assert max(plotted(simple, "moment", step=0)["moment"][1]) == pytest.approx(-q / 2 * L**2 / 8)
    assert axes.get_title() == "Step 1, half" and axes.get_ylabel() == "moment [kN m]" and axes.get_xlabel() == "x [m]"


def test_plot_draws_a_face_at_its_place_unless_it_is_far_away_and_a_pair_in_contact_on_the_beam(simple, matplotlib):
    assert plotted(simple)["face"] == ([3.0], [-0.3])
    simple["contact"][0]["face"] = -0.1
    w = contct.run(simple, kernels="corrected").steps[1].w[1]
    lines = plotted(simple)
    assert lines["in contact"] == ([3.0], [w]) and w < -0.1 and lines["face"] == ([], [])
    simple["contact"][0]["face"] = -100.0
    assert plotted(simple)["face"] == ([], [])


def test_plot_draws_a_dot_at_an_extreme_between_nodes(simple, matplotlib):
    simple["beam"]["elements"] = 1
    simple["support"][0]["nodes"] = [1, 2]
    del simple["contact"]
    xs, ys = plotted(simple, "moment")["extremes"]
    assert (xs[1], ys[1]) == pytest.approx((L / 2, -q * L**2 / 8))


def test_plot_draws_a_plate_in_colours_on_the_given_axes(matplotlib):
    plate = {"plate": {"x": [0.0, 1.0, 3.0], "y": [0.0, 2.0], "D": 1.0, "nu": 0.3},
             "support": [{"nodes": [1, 4], "fix": ["w", "wx", "wy"]}], "step": [{"uniform": -0.01}]}
    result = contct.run(plate, kernels="corrected")
    given = pytest.importorskip("matplotlib.pyplot").subplots()[1]
    assert result.plot(ax=given) is given
    low, high = given.figure.axes[1].get_ylim()  # the range of the colour bar
    assert low <= min(result.steps[0].w) < 0.5 * low and high >= 0
    assert given.get_xlim() == (0.0, 3.0) and given.get_ylim() == (0.0, 2.0) and given.get_title() == "Step 1: w"
    with pytest.raises(contct.InputError, match="found quantity 'moment' of a plate; allowed: w, wx, wy, mx, my, mxy$"):
        result.plot("moment")


def test_plot_refuses_a_quantity_or_a_result_that_cannot_be_drawn(simple, monkeypatch):
    result = contct.run(simple, kernels="corrected")
    with pytest.raises(contct.InputError, match="found quantity 'mx' of a beam; allowed: w, theta, shear, moment"):
        result.plot("mx")
    with pytest.raises(contct.InputError, match="allowed: a result of contct.run without final_only"):
        contct.certify(simple, [[0.0] * 6]).plot()
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match="It needs matplotlib"):
        result.plot()
    assert pickle.loads(pickle.dumps(result)) == result


def test_every_quantity_of_a_beam_and_of_a_plate_can_be_drawn(simple, matplotlib):
    simple["bed"] = [{"modulus": 10.0, "face": 0.0}]
    simple["beam"] = {"length": L, "elements": 2, "section": {"E": EI, "I": 1.0, "W": 0.5}}
    end = contct.run(simple, kernels="corrected").steps[1]
    assert plotted(simple, "pressure")["pressure"][1] == pytest.approx(list(end.pressure))
    assert plotted(simple, "stress")["stress"][1] == pytest.approx([v for e in end.elements for v in e.stress])
    plate = {"plate": {"size": [2.0, 1.0], "elements": [2, 1], "D": 10.0, "nu": 0.3}, "bed": [{"modulus": 1.0, "face": 0.0}],
             "step": [{"uniform": -1.0, "point": [{"node": 3, "w": -1.0}]}]}
    drawn = contct.run(plate)
    for quantity in ("w", "wx", "pressure", "mx", "mxy"):
        assert quantity in drawn.plot(quantity).get_title()
