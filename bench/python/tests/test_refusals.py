"""Bad input is an exception with field, value and range, and nothing is lost."""

from __future__ import annotations

import pathlib
import pickle
from typing import Any, Callable

import numpy as np
import pytest

import epas_friction as ef

DESIGN: dict[str, Any] = {
    "pitch_radius": 0.0165, "lead": 0.02, "ball_radius": 2.778e-3, "conformity": 0.56, "contact_angle": 0.7854, "loaded_balls": 37,
}  # fmt: skip


def refusal(call: Callable[[], Any]) -> ef.Error:
    with pytest.raises(ef.Error) as error:
        call()
    return error.value


@pytest.mark.parametrize(
    ("change", "field", "value"),
    [
        ({"lead": -1.0}, "lead", -1.0),
        ({"lead": float("nan")}, "lead", None),
        ({"lead": float("inf")}, "lead", float("inf")),
        ({"friction": 0.7}, "friction", 0.7),
        ({"clearance": 0.5}, "clearance", 0.5),
        ({"ball_radius": 0.5}, "ball_radius", 0.5),
        ({"limits": {"nut_speed": -3}}, "nut_speed", -3.0),
        ({"loaded_balls": 0}, "loaded_balls", 0.0),
        ({"lead_": 0.1}, "lead_", None),
        ({"lead": None}, "lead", None),
        ({"lead": object()}, "lead", None),
        ({"lead": "7"}, None, None),
        ({"branch": "spinning"}, None, None),
        ({"preload": 1.0, "clearance": 0.0}, None, None),
    ],
)
def test_designs(change: dict[str, Any], field: str, value: float) -> None:
    error = refusal(lambda: ef.Design(**{**DESIGN, **change}))
    assert isinstance(error, ValueError)
    assert error.field == field
    if value is not None:
        assert error.value == pytest.approx(value) and error.range is not None
        assert error.range[0] <= error.range[1] and not error.range[0] <= value <= error.range[1]


def test_designs_from_elsewhere(tmp_path: pathlib.Path) -> None:
    assert refusal(lambda: ef.Design.built_in("lin-9")).field == "name"
    refusal(lambda: ef.Design.read(tmp_path / "none.toml"))
    file = tmp_path / "design.toml"
    file.write_text("lead = [")
    refusal(lambda: ef.Design.read(file))
    file.write_text(ef.Design(**DESIGN, friction=0.11).toml())
    again = ef.Design.read(str(file))
    assert (again.friction, again.lead) == (np.float32(0.11), np.float32(0.02))
    with pytest.raises(TypeError):
        ef.Design.read(7)  # type: ignore[arg-type]
    assert len(ef.design_names()) > 30


@pytest.mark.parametrize(
    "value", ["0.3", None, True, [0.1, "a"], [[0.1], [0.2, 0.3]], np.array(["0.1"]), 0.1j, np.array([True]), {}, object(),
              np.ma.masked_array([0.1, 0.2], [False, True]), np.array([0.1, None], dtype=object)],
)  # fmt: skip
def test_what_is_no_number(value: Any) -> None:
    error = refusal(lambda: ef.friction_map(0.3, value))
    assert isinstance(error, ef.NumberTypeError) and isinstance(error, TypeError)
    assert error.field == "offset" and "offset must be" in str(error)


def test_values_in_arrays() -> None:
    angles = np.full((3, 4), 0.7)
    angles[1, 2] = 2.0
    error = refusal(lambda: ef.groove_curvature("nut", 0.0165, 0.19, angles, 3.1e-3, 2e-4, 2e-4))
    assert (error.field, error.value, error.index) == ("contact_angle", 2.0, (1, 2))
    assert error.range == (0.0, np.float32(np.pi / 2))
    for bad in [np.nan, np.inf, -np.inf, 1e300]:
        error = refusal(lambda: ef.ellipse(1e-3, 2e-3, [1.0, bad], 1e11))
        assert (error.field, error.index) == ("load", (1,))
    assert refusal(lambda: ef.reference.ellipse(1e-3, -2e-3, 1.0, 1e11)).index is None
    assert refusal(lambda: ef.efficiency(0.1, 0.7, 0.1, [0.1, 9.0])).index == (1,)
    assert refusal(lambda: ef.reference.efficiency(0.1, 0.7, 0.1, [0.1, 9.0])).index == (1,)
    assert refusal(lambda: ef.groove_curvature("Screw", 1, 1, 1, 1, 1, 1)).field == "groove"
    assert refusal(lambda: ef.reference.friction_map([0.5, 1e-9], 0.0)).field == "axis_ratio"


def test_shapes() -> None:
    error = refusal(lambda: ef.friction_map(np.zeros(3), np.zeros((2, 4))))
    assert isinstance(error, ef.ShapeError)
    assert "axis_ratio [3], offset [2, 4]" in str(error)
    screw = ef.CagedBallScrew(ef.Design(**DESIGN))
    for speed, load in [(np.zeros(3), np.zeros(4)), (np.zeros((2, 3)), 1.0)]:
        assert isinstance(refusal(lambda: screw.run(speed, load)), ef.ShapeError)
    assert screw.run([], 1.0).friction_torque.shape == (0,)


def test_a_refused_trace_leaves_the_model_as_it_was() -> None:
    screw = ef.UncagedBallScrew(ef.Design.built_in("lin-3.6"))
    screw.run(np.full(300, 5.0), 1500.0)
    expected = screw.copy().step(5.0, 1500.0)
    error = refusal(lambda: screw.run([5.0, 5.0, np.nan], 1500.0))
    assert (error.field, error.index) == ("nut_speed", (2,)) and np.isnan(error.value or 0.0)
    assert screw.step(5.0, 1500.0) == expected


def test_faults_are_flagged_where_they_are_let_in() -> None:
    screw = ef.CagedBallScrew(ef.Design(**DESIGN))
    run = screw.run([5.0, np.nan, 5.0], [1e3, 1e3, np.inf], allow_faults=True)
    assert [ef.Faults(bits) for bits in run.faults] == [
        ef.Faults.NONE, ef.Faults.SPEED_NOT_FINITE, ef.Faults.LOAD_NOT_FINITE,
    ]  # fmt: skip
    assert screw.faulted_ticks == 2
    outputs = screw.step(float("nan"), 1e3)
    assert outputs.friction_torque == 0.0 and outputs.faults == ef.Faults.SPEED_NOT_FINITE


def test_scenes() -> None:
    design = ef.Design(**DESIGN)
    assert refusal(lambda: ef.UncagedBallScrew(design)).field == "uncaged"
    pressing = ef.Design.built_in("lin-3.6")
    for options, field in [({"tick": 1.0}, "tick"), ({"friction": -1.0}, "friction"), ({"tick": float("nan")}, "tick")]:
        assert refusal(lambda: ef.UncagedBallScrew(pressing, **options)).field == field
        assert refusal(lambda: ef.LinearBearingTrain(ef.LinearDesign.built_in(), **options)).field == field
    assert refusal(lambda: ef.CagedBallScrew(design, branch="none")).field == "branch"
    assert refusal(lambda: ef.CagedBallScrew(design, friction=2.0)).range == (np.float32(1e-3), 0.5)
    assert refusal(lambda: ef.CagedBallScrewWithMemory(design, reference_load=-1.0)).field == "reference_load"
    refused = refusal(lambda: ef.CagedBallScrewWithMemory(design, reference_load=1.0, encoder_step=1.0))
    assert refused.field == "encoder_step"
    with pytest.raises(OverflowError):
        ef.CagedBallScrew(design, loaded_balls=70_000)
    with pytest.raises(TypeError):
        ef.CagedBallScrew("lin-4.1")  # type: ignore[arg-type]
    assert refusal(lambda: ef.simulate_uncaged(pressing, [0.0, 1e-3, 5e-3], 1.0, 1.0)).args
    assert refusal(lambda: ef.simulate_caged(design, [0.0, -1e-3], 1.0, 1.0)).field == "time"
    for time in ([], [0.0], [0.0, 1e-3, 1e-3]):
        assert refusal(lambda: ef.simulate_caged(design, time, 1.0, 1.0)).field == "time"
        assert refusal(lambda: ef.reference.simulate_caged(design, time, 1.0, 1.0)).field == "time"
    assert refusal(lambda: ef.manoeuvre("drift", design)).field == "name"
    with_memory = ef.LinearBearingTrain(ef.LinearDesign.built_in(), memory_load=100.0)
    assert refusal(lambda: with_memory.set_carriage_position(0.1)).field == "position"


def test_eval() -> None:
    error = refusal(lambda: ef.eval("hertz"))
    assert (error.field, str(error)) == ("relative_radius_1", "relative_radius_1: is missing")
    error = refusal(lambda: ef.eval("friction_map", axis_ratio=0.5, offset=2e10))
    assert str(error).startswith("offset = 20000000000 is out of range")
    assert refusal(lambda: ef.eval("friction_map", axis_ratio=np.float32(0.5), offset=np.array(2e10))).field == "offset"
    assert refusal(lambda: ef.eval("nothing")).field == "model"
    assert refusal(lambda: ef.eval("friction_map", axis_ratio=float("nan"), offset=0.0)).field == "request"
    with pytest.raises(TypeError):
        ef.eval("hertz", load=object())


def test_errors_go_from_process_to_process() -> None:
    error = refusal(lambda: ef.ellipse(1e-3, 2e-3, [1.0, -1.0], 1e11))
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) and vars(again) == vars(error)


@pytest.mark.parametrize("value", [1e300, -1e300, 1e-60])
def test_numbers_that_single_precision_does_not_hold(value: float) -> None:
    contact = {"contact_modulus": 1e11, "relative_radius_1": 1e-3, "relative_radius_2": 2e-3, "load": 1.0}
    screw = ef.CagedBallScrew(ef.Design(**DESIGN), branch="sliding")
    pressing, bearing = ef.Design.built_in("lin-3.6"), ef.LinearDesign.built_in()
    calls: list[tuple[str, Callable[[], Any]]] = [
        ("load", lambda: ef.ellipse(**{**contact, "load": value})),
        ("load", lambda: ef.ellipse(**{**contact, "load": [1.0, value]})),
        ("contact_modulus", lambda: ef.ellipse(**{**contact, "contact_modulus": value})),
        ("friction", lambda: ef.efficiency(0.1, 0.7, np.full((3, 5), value)[:, ::2], 0.1)),
        ("rolling_tangent", lambda: ef.efficiency(0.1, 0.7, 0.1, 0.1, value)),
        ("friction", lambda: ef.Design(**DESIGN, friction=value)),
        ("friction", lambda: screw.set_friction(value)),
        ("friction", lambda: ef.CagedBallScrew(ef.Design(**DESIGN), friction=value)),
        ("reversal_speed", lambda: ef.CagedBallScrew(ef.Design(**DESIGN), reversal_speed=value)),
        ("tick", lambda: ef.UncagedBallScrew(pressing, tick=value)),
        ("ball_friction", lambda: ef.LinearBearingTrain(bearing, ball_friction=value)),
        ("axial_load", lambda: ef.design_figures(0.0145, 0.007, 0.002, axial_load=value)),
    ]
    for field, call in calls:
        error = refusal(call)
        assert error.field == field and error.value == pytest.approx(value), (field, error)
        assert error.range is not None and "single precision" in str(error), (field, error)


def test_traces_beyond_single_precision() -> None:
    screw = ef.CagedBallScrew(ef.Design(**DESIGN), branch="sliding")
    error = refusal(lambda: screw.run([1.0, 1e300], 100.0))
    assert (error.field, error.value, error.index) == ("nut_speed", 1e300, (1,)) and error.range is not None
    assert refusal(lambda: ef.simulate_caged(ef.Design(**DESIGN), [0.0, 1.0], 1.0, -1e300)).field == "axial_load"
    # What decays below it is at rest.
    decaying = 10.0 * np.exp(-np.arange(300.0))
    assert np.all(screw.run(decaying, 100.0).faults == 0)
    assert screw.run([1e300], 100.0, allow_faults=True).fault_words[0] == "SPEED_NOT_FINITE"


def test_a_bound_names_the_field_that_decides_it() -> None:
    for model, design, limit in [
        (ef.UncagedBallScrew, ef.Design.built_in("lin-3.6"), "limits.nut_speed = 2000"),
        (ef.LinearBearingTrain, ef.LinearDesign.built_in(), "limits.speed = 2"),
    ]:
        error = refusal(lambda: model(design, tick=0.5))
        assert limit in str(error) and error.range is not None and error.range[0] > 0.0
        # Both ends are allowed.
        for tick in error.range:
            assert model(design, tick=tick).tick == np.float32(tick)
        assert "allowed: 0 to" not in str(refusal(lambda: model(design, tick=0.0)))


def test_an_end_that_is_refused_is_not_said_to_be_allowed() -> None:
    trace = {"time": np.arange(1000) * 1e-3, "position": np.zeros(1000), "motor_force": np.zeros(1000)}
    error = refusal(lambda: ef.calibrate(trace, controller=(0.0, 1.0)))
    assert (error.field, error.value) == ("gain_position", 0.0) and "allowed: above 0" in str(error)
    lengths = {**DESIGN, "ball_radius": 0.0}
    assert "allowed: 0 to" not in str(refusal(lambda: ef.Design(**lengths)))
