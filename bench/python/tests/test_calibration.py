"""A calibration from arrays is the calibration of the command ``calibrate``, and says what it cannot."""

from __future__ import annotations

import json
import pathlib
import subprocess
from typing import Any

import numpy as np
import pytest

import epas_friction as ef

DESIGN = ef.Design.built_in("lin-4.1")


def part(trace: dict[str, Any], seconds: float) -> dict[str, Any]:
    """The first seconds of a trace."""
    keep = trace["time"] <= trace["time"][0] + seconds
    return {name: values[keep] for name, values in trace.items()}


def commanded(program: str, folder: pathlib.Path, trace: dict[str, Any], *arguments: str) -> dict[str, Any]:
    """What the command says to the same numbers in a file."""
    file = folder / "trace.csv"
    lines = [",".join(trace)] + [",".join(map(repr, row)) for row in zip(*(values.tolist() for values in trace.values()))]
    file.write_text("\n".join(lines) + "\n")
    done = subprocess.run(
        [program, "calibrate", str(file), "--json", "--output", str(folder / "page"), *arguments],
        check=True, capture_output=True, text=True,
    )  # fmt: skip
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def same(estimates: dict[str, ef.Estimate], expected: dict[str, Any]) -> None:
    assert list(estimates) == list(expected)
    for name, estimate in estimates.items():
        for key in ["value", "low", "high", "fixed", "unit"]:
            value = getattr(estimate, key)
            if expected[name][key] is None:
                assert not np.isfinite(value)
            else:
                assert value == expected[name][key], (name, key)


def test_with_a_design(program: str, tmp_path: pathlib.Path) -> None:
    trace = part(ef.reference.measured_trace("vehicle", seed=3), 25.0)
    told = ef.calibrate(trace, DESIGN, estimate=["friction", "preload"], fix={"inertia": 4e-4}, models=False)
    answer = commanded(
        program, tmp_path, trace, "--design", "lin-4.1", "--estimate", "friction,preload", "--fix", "inertia=0.0004"
    )
    same(told.parameters, answer["parameters"])
    assert (told.residual_rms, told.relative_error, told.cannot_tell) == (
        answer["residual_rms"], answer["relative_error"], answer["cannot_tell"],
    )  # fmt: skip
    assert told.models == [] and told.winner is None
    assert told["friction"].low < told["friction"].value < told["friction"].high
    assert told.time.shape == told.measured.shape == told.model.shape
    # The residual is what the picture's two curves leave.
    left = np.sqrt(np.mean((told.measured - told.model) ** 2))
    assert left == pytest.approx(told.residual_rms, rel=0.2)


def sliding() -> dict[str, Any]:
    """A mass of 20 kg with 8 N of friction and 30 N s/m of drag, shaken for 8 s."""
    time = np.arange(2000) * 4e-3
    speed = 0.05 * np.sin(2 * np.pi * 0.4 * time) + 0.04 * np.sin(2 * np.pi * 1.3 * time + 0.4)
    acceleration = np.gradient(speed, time)
    noise = np.random.default_rng(2).normal(0.0, 0.05, time.size)
    force = 20.0 * acceleration + 8.0 * np.tanh(speed / 1e-4) + 30.0 * speed + noise
    return {"time": time, "speed": speed, "motor_force": force}


def test_without_a_design(program: str, tmp_path: pathlib.Path) -> None:
    trace = sliding()
    told = ef.calibrate(trace)
    answer = commanded(program, tmp_path, trace)
    same(told.parameters, answer["parameters"])
    assert (told.winner, told.residual_rms) == (answer["winner"], answer["residual_rms"])
    assert [model.name for model in told.models] == [model["name"] for model in answer["models"]]
    for model, expected in zip(told.models, answer["models"]):
        assert model.relative_error_unseen == expected["relative_error_unseen"]
        same(model.values, expected["values"])
    # Twice the interval, where the truth is in 95 of 100 within one: the friction law of the trace is none of the models'.
    mass = told["mass"]
    assert abs(mass.value - 20.0) < max(2.0 * (mass.high - mass.low), 0.2)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"motor_force": None}, None),
        ({"time": np.zeros(2000)}, None),
        ({"speed": np.zeros(7)}, "speed"),
        ({"speed": ["a"]}, "speed"),
        ({"speed": np.full(2000, np.nan)}, "speed"),
        ({"speed_furlong": np.zeros(2000)}, "speed_furlong"),
        ({"a,b": np.zeros(2000)}, "a,b"),
    ],
)
def test_bad_traces(change: dict[str, Any], field: str) -> None:
    trace = {name: values for name, values in {**sliding(), **change}.items() if values is not None}
    with pytest.raises(ef.Error) as error:
        ef.calibrate(trace)
    if field is not None:
        assert error.value.field == field


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"ratio": 2.0}, "ratio"),
        ({"estimate": ["friction"]}, "estimate"),
        ({"fix": {"friction": 0.1}}, "fix"),
        ({"design": DESIGN, "ratio": 0.0}, "ratio"),
        ({"design": DESIGN, "controller": (1.0, 2.0)}, "controller"),
        ({"controller": (-1.0, 2.0)}, "gain_position"),
        ({"controller": (1.0, float("nan"))}, "gain_speed"),
    ],
)
def test_bad_options(options: dict[str, Any], field: str) -> None:
    with pytest.raises(ef.Error) as error:
        ef.calibrate(sliding(), **options)
    assert error.value.field == field
    with pytest.raises(ef.Error):
        ef.calibrate([1.0, 2.0])  # type: ignore[arg-type]
