"""Studies of designs and of traces: any part of them is the same part of the whole."""

from __future__ import annotations

import json

import numpy as np
import pytest

import epas_friction as ef

LEADS = np.linspace(5e-3, 20e-3, 24, dtype=np.float32)


def figures(leads, **other):
    return ef.design_figures(14.5e-3, leads, 2e-3, preload=20.0, **other)


def test_any_partition_of_designs_has_the_same_bits():
    whole = figures(LEADS)
    for size in (1, 5, 23):
        parts = [figures(LEADS[first : first + size]) for first in range(0, len(LEADS), size)]
        for name in whole._fields:
            joined = np.concatenate([getattr(part, name) for part in parts])
            assert joined.tobytes() == getattr(whole, name).tobytes(), name


def test_a_study_has_the_friction_of_the_scene():
    # A study has the exact ball that the scene is folded from, without rolling resistance, which is 1 % of the friction here.
    design = ef.Design.built_in("lin-4.1")
    found = ef.design_figures(14.5e-3, 7e-3, 2e-3, 0.54, np.pi / 4, axial_load=3000.0, friction=0.075, turns=71.5 * 4e-3 / (np.pi * 29e-3))
    assert found.loaded_balls == 71
    torque = ef.CagedBallScrew(design).run([100.0], 3000.0).friction_torque[0]
    assert found.friction_torque == pytest.approx(torque, rel=0.06)


def test_wrong_designs_are_named_or_left_out():
    leads = np.array([7e-3, -1.0], dtype=np.float32)
    with pytest.raises(ef.Error) as refused:
        figures(leads)
    assert refused.value.field == "lead"
    assert refused.value.index == (1,)
    lenient = figures(leads, strict=False)
    assert np.isfinite(lenient.friction_torque[0])
    assert np.isnan(lenient.friction_torque[1])
    with pytest.raises(ef.Error) as refused:
        figures(LEADS, friction=float("nan"))
    assert refused.value.field == "friction"


def trace(number):
    random = np.random.default_rng(number)
    time = np.arange(0.0, 4.0, 2e-3)
    angle = 6.0 * np.sin(np.pi * time) + 1.5 * np.sin(10.7 * time + number)
    speed = 6.0 * np.pi * np.cos(np.pi * time) + 1.5 * 10.7 * np.cos(10.7 * time + number)
    acceleration = -6.0 * np.pi**2 * np.sin(np.pi * time) - 1.5 * 10.7**2 * np.sin(10.7 * time + number)
    inertia = 4e-4 * (1.0 + 0.05 * random.standard_normal())
    torque = inertia * acceleration + 2e-3 * speed + 0.12 * np.sign(speed)
    return {"time": time, "motor_position": angle, "motor_torque": torque + random.normal(0.0, 2e-3, len(time))}


def test_sums_of_any_partition_are_those_of_the_whole():
    sums = [ef.trace_sums(trace(number)) for number in range(6)]
    merged = ef.merge_sums(sums)
    assert merged == ef.merge_sums([ef.merge_sums(sums[4:]), ef.merge_sums(sums[:4])])
    whole = ef.population(merged)
    assert all(one["traces"] == 6 for one in whole)
    inertia = next(one for one in whole if one["name"] in ("inertia", "mass"))
    # Of six drives that scatter by 5 % the mean scatters by 2 %.
    assert inertia["mean"] == pytest.approx(4e-4, rel=0.08)


def test_what_holds_no_sums_is_refused():
    for parts in ([], ["{}"], ["no json"], [json.dumps([{"names": ["mass"]}])]):
        with pytest.raises(ef.Error):
            ef.merge_sums(parts)
    with pytest.raises(ef.Error):
        ef.trace_sums({"time": np.arange(10.0)})


def test_a_ratio_is_checked():
    design = ef.Design.built_in("lin-4.1")
    for ratio in (0.0, -1.0, 1e4, float("nan")):
        with pytest.raises(ef.Error) as refused:
            ef.trace_sums(trace(0), design, ratio=ratio)
        assert refused.value.field == "ratio"
        assert refused.value.range == (0.01, 1000.0)
    with pytest.raises(ef.Error, match="ratio needs a design"):
        ef.trace_sums(trace(0), ratio=2.0)
