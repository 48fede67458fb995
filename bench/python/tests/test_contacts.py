"""Functions over arrays give the bits of ``eval``, which computes one request after the other."""

from __future__ import annotations

import itertools
from typing import Any, Callable

import numpy as np
import numpy.typing as npt
import pytest

import epas_friction as ef

#: Answers of ``eval`` to requests of one model.
Ask = Callable[[str, list[dict[str, Any]]], list[dict[str, Any]]]

SLIP = ["rolling_slip", "side_slip", "spin", "entrainment_speed", "entrainment_angle", "slide_to_roll", "slide_angle", "spin_to_roll"]


def same(array: npt.NDArray[Any], values: list[Any], kind: type) -> None:
    """Equal to the last bit; null in JSON is NaN."""
    expected = np.array([np.nan if value is None else value for value in values], dtype=kind)
    assert array.dtype == expected.dtype
    np.testing.assert_array_equal(array.ravel(), expected, strict=True)


def numbers(requests: list[dict[str, Any]]) -> dict[str, npt.NDArray[np.float64]]:
    """Requests as arrays."""
    return {name: np.array([request[name] for request in requests]) for name in requests[0]}


@pytest.mark.parametrize("groove", ["screw", "nut"])
def test_curvature(ask: Ask, groove: str) -> None:
    grid = itertools.product([0.0145, 0.0165], [0.01, 0.0767, 0.19], [0.2, 0.7853, 1.4])
    requests = [
        {"pitch_radius": r, "lead_angle": a, "contact_angle": b, "groove_radius": 2.24e-3, "offset_h": 1.6e-4, "offset_l": 1.7e-4}
        for r, a, b in grid
    ]
    answers = ask("groove_curvature", [{"groove": groove, "ball_radius": 2e-3, **request} for request in requests])
    fields = numbers(requests)
    exact = ef.groove_curvature(groove, **fields)
    same(exact.kappa1, [answer["in_loop"]["kappa1"] for answer in answers], np.float32)
    same(exact.kappa2, [answer["in_loop"]["kappa2"] for answer in answers], np.float32)
    same(ef.fitted_curvature(groove, **fields), [answer["in_loop"]["fitted"] for answer in answers], np.float32)
    reference = ef.reference.groove_curvature(groove, **fields)
    same(reference.kappa1, [answer["reference"]["kappa1"] for answer in answers], np.float64)
    same(reference.kappa2, [answer["reference"]["kappa2"] for answer in answers], np.float64)
    del fields["offset_h"], fields["offset_l"]
    circular = ef.circular_groove_curvature(groove, **fields)
    same(circular, [answer["in_loop"]["circular_groove"] for answer in answers], np.float32)
    literature = ef.literature_curvature(groove, fields["pitch_radius"], fields["contact_angle"], 2e-3)
    same(literature, [answer["in_loop"]["literature"] for answer in answers], np.float32)


def test_ellipse(ask: Ask) -> None:
    grid = itertools.product([1e-3, 7e-3], [2e-2, 0.5], [1e-6, 10.0, 3000.0])
    requests = [
        {"relative_radius_1": a, "relative_radius_2": b, "load": load, "contact_modulus": 1.13e11} for a, b, load in grid
    ]
    answers = ask("hertz", requests)
    fields = numbers(requests)
    for module, part, kind in [(ef, "in_loop", np.float32), (ef.reference, "reference", np.float64)]:
        ellipse = module.ellipse(**fields)
        for name in ["axis_ratio", "semi_major", "semi_minor", "deflection", "max_pressure"]:
            same(getattr(ellipse, name), [answer[part][name] for answer in answers], kind)


def test_efficiency(ask: Ask) -> None:
    grid = itertools.product([1e-3, 0.05, 0.4], [0.7, 0.8], [0.0, 0.05, 0.3], [0.0, 0.01])
    requests = [
        {"lead_angle": a, "contact_angle": b, "friction": f, "ball_ratio": 0.15, "rolling_tangent": t} for a, b, f, t in grid
    ]
    answers = ask("efficiency", requests)
    fields = numbers(requests)
    for module, part, kind in [(ef, "in_loop", np.float32), (ef.reference, "reference", np.float64)]:
        efficiency = module.efficiency(**fields)
        for name in ["rolling_screw", "sliding_drive", "sliding_backdrive", "loss_drive"]:
            same(getattr(efficiency, name), [answer[part][name] for answer in answers], kind)
        for name in ["locked_drive", "locked_backdrive"]:
            same(getattr(efficiency, name), [answer[part][name] for answer in answers], np.bool_)


def test_kinematics(ask: Ask) -> None:
    usual = {
        "ball_diameter": 6.35e-3, "pitch_radius": 0.0165, "lead_angle": 0.19, "groove_radius_screw": 3.5e-3,
        "groove_radius_nut": 3.5e-3, "contact_angle_screw": 0.78, "contact_angle_nut": 0.8, "pitch_angle": 0.7,
        "yaw_angle": 0.05, "rolling_radius_screw": 3.2e-3, "rolling_radius_nut": 3.2e-3, "speed": 30.0,
        "semi_major_screw": 3e-4, "semi_minor_screw": 6e-5, "semi_major_nut": 3.2e-4, "semi_minor_nut": 7e-5,
    }  # fmt: skip
    requests = [{**usual, "speed": speed, "pitch_angle": pitch} for speed in [-5.0, 0.0, 1e-3, 400.0] for pitch in [0.5, 0.8]]
    answers = ask("contact_kinematics", requests)
    fields = numbers(requests)
    for module, part, kind in [(ef, "in_loop", np.float32), (ef.reference, "reference", np.float64)]:
        ball = module.contact_kinematics(**fields)
        same(ball.orbital_speed, [answer[part]["orbital_speed"] for answer in answers], kind)
        same(ball.spin_speed, [answer[part]["spin_speed"] for answer in answers], kind)
        for place in ["screw", "nut"]:
            for name in SLIP:
                values = [answer[part][place][name] for answer in answers]
                same(getattr(getattr(ball, place), name), values, kind)


def test_friction_map(ask: Ask) -> None:
    ratios, offsets = np.array([0.05, 0.3, 1.0])[:, None], np.array([-1e3, -1.0, -0.2, 0.0, 1e-3, 0.9, 1.1, 40.0])
    requests = [{"axis_ratio": ratio, "offset": offset} for ratio in ratios.ravel() for offset in offsets]
    answers = ask("friction_map", requests)
    for module, part, kind in [(ef, "in_loop", np.float32), (ef.reference, "reference", np.float64)]:
        map = module.friction_map(ratios, offsets)
        assert map.force.shape == (3, 8)
        for name in ["force", "moment", "power"]:
            same(getattr(map, name), [answer[part][name] for answer in answers], kind)


def test_eval_is_the_program(ask: Ask) -> None:
    request = {"form": "proportional", "table": "slip8", "angle": [0.0, 0.5, -0.2, 1.5], "limit_ratio": [1.0, 1.2]}
    [answer] = ask("presliding", [request])
    assert ef.eval("presliding", **request) == {part: answer[part] for part in ["in_loop", "reference"]}


def test_layouts_of_memory_give_the_same() -> None:
    offsets = np.linspace(-2.0, 2.0, 12, dtype=np.float32)
    expected = ef.friction_map(np.float32(0.3), offsets).force
    packed = np.zeros(12, dtype=[("gap", "i2"), ("offset", "f4")])
    packed["offset"] = offsets
    wide = np.zeros((12, 3), dtype=np.float32)
    wide[:, 1] = offsets
    layouts: list[Any] = [
        offsets.astype(np.float64), offsets.astype(">f4"), packed["offset"], wide[:, 1], offsets[::-1][::-1], list(offsets),
        offsets.astype(np.longdouble), np.frombuffer(b"x" + offsets.tobytes(), np.uint8)[1:].view(np.float32),
    ]  # fmt: skip
    for layout in layouts:
        np.testing.assert_array_equal(ef.friction_map(np.float32(0.3), layout).force, expected)
    np.testing.assert_array_equal(ef.friction_map(np.float32(0.3), offsets.reshape(3, 4).T).force, expected.reshape(3, 4).T)
    whole = ef.friction_map(1, [0, 1, 2]).force
    np.testing.assert_array_equal(whole, ef.friction_map(1.0, np.array([0, 1, 2], np.uint8)).force)
    assert ef.friction_map(0.3, np.zeros((0, 4))).force.shape == (0, 4)
    assert ef.friction_map(0.3, 0.1).force.shape == ()


@pytest.mark.parametrize("balls", [2, 8, 9, 37, 64])
def test_balls_that_press(balls: int) -> None:
    random = np.random.default_rng(balls)
    free, impedance = random.normal(0.0, 1e-3, (200, balls)), random.uniform(0.5, 2.0, (200, balls))
    forces = ef.contact_forces(free, impedance)
    assert forces.shape == (200, balls - 1) and forces.dtype == np.float32
    # No ball passes through another, none pulls, and none presses on one that runs away: within 6e-7 of the largest force, which is
    # the promise for impedances that differ by a factor of 4, twice for the sums of two forces, and the rounding of the inputs.
    push = np.pad(forces.astype(np.float64), ((0, 0), (1, 1)))
    speed = free + (push[:, :-1] - push[:, 1:]) / impedance
    gap = np.diff(speed, axis=1)
    slack = 4e-6 * max(forces.max(), 1e-3) / 0.5
    assert forces.min() >= 0.0 and gap.min() > -slack
    assert np.abs(gap[forces > 0.0]).max() < slack and (forces > 0.0).any()


def test_rows_of_balls_are_refused() -> None:
    for shape in [(), (1,), (3, 65), (0,)]:
        with pytest.raises(ef.ShapeError):
            ef.contact_forces(np.zeros(shape), 1.0)
    with pytest.raises(ef.Error) as error:
        ef.contact_forces(np.zeros((2, 3)), [1.0, 0.0, 1.0])
    assert (error.value.field, error.value.index) == ("impedance", (0, 1))
