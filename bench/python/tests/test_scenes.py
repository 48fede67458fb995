"""Scenes over whole traces give the bits of ``simulate``; ticks one by one give the bits of a whole trace."""

from __future__ import annotations

import csv
import pathlib
import re
import subprocess
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import epas_friction as ef

REGIMES = {"standing": 0, "driving": 1, "back-driving": 2, "locked": 3}
#: Columns of the program by the names of the results.
NAMES = {"groove_torque": "groove_friction", "ball_torque": "ball_friction", "groove_force": "groove_friction", "ball_force": "ball_friction"}


def simulated(program: str, folder: pathlib.Path, *arguments: str) -> dict[str, list[str]]:
    """Columns of the file that ``simulate`` writes."""
    out = folder / "out.csv"
    subprocess.run([program, "simulate", *arguments, "--output", str(out)], check=True, capture_output=True)
    with out.open() as file:
        rows = list(csv.reader(file))
    return {name: [row[place] for row in rows[1:]] for place, name in enumerate(rows[0])}


def same(run: Any, columns: dict[str, list[str]]) -> None:
    """Every array of a run is the program's column, to the last bit."""
    for name, array in vars(run).items():
        if NAMES.get(name, name) not in columns:
            continue
        texts = columns[NAMES.get(name, name)]
        values = [REGIMES[text] for text in texts] if name == "regime" else texts
        # float32 from the shortest decimal number that tells it from its neighbours.
        np.testing.assert_array_equal(array, np.array(values).astype(array.dtype), err_msg=name, strict=True)
    assert sum(NAMES.get(name, name) in columns for name in vars(run)) >= 5


def numbers(columns: dict[str, list[str]], *names: str) -> list[npt.NDArray[np.float64]]:
    return [np.array(columns[name], dtype=np.float64) for name in names]


SCREW = ["time", "nut_speed", "axial_load"]


@pytest.mark.parametrize("memory", [False, True])
@pytest.mark.parametrize("manoeuvre", ["parking", "weave", "kerb"])
def test_caged(program: str, tmp_path: pathlib.Path, manoeuvre: str, memory: bool) -> None:
    flags = ["--memory"] if memory else ["--no-memory"]
    columns = simulated(program, tmp_path, "--design", "lin-4.1", "--manoeuvre", manoeuvre, *flags)
    design = ef.Design.built_in("lin-4.1")
    time, speed, load = numbers(columns, *SCREW)
    for given, made in zip([time, speed, load], ef.manoeuvre(manoeuvre, design)):
        np.testing.assert_array_equal(given, made)
    same(ef.simulate_caged(design, time, speed, load, memory=memory), columns)
    if not memory:
        same(ef.CagedBallScrew(design).run(speed.astype(np.float32), load.astype(np.float32)), columns)


@pytest.mark.parametrize("memory", [False, True])
def test_uncaged(program: str, tmp_path: pathlib.Path, memory: bool) -> None:
    flags = ["--memory"] if memory else ["--no-memory"]
    columns = simulated(program, tmp_path, "--manoeuvre", "turns", *flags)
    design = ef.Design.built_in("lin-3.6")
    assert design.circuit_balls == 37
    same(ef.simulate_uncaged(design, *numbers(columns, *SCREW), memory=memory), columns)


@pytest.mark.parametrize("memory", [False, True])
def test_linear(program: str, tmp_path: pathlib.Path, memory: bool) -> None:
    flags = ["--memory"] if memory else ["--no-memory"]
    columns = simulated(program, tmp_path, "--manoeuvre", "stroke", *flags)
    trace = numbers(columns, "time", "speed", "normal_load", "side_load")
    same(ef.simulate_linear(ef.LinearDesign.built_in(), *trace, memory=memory), columns)


def test_the_exact_screw(program: str, tmp_path: pathlib.Path) -> None:
    trace = tmp_path / "trace.csv"
    time, load = np.arange(40) * 1e-3, 2000.0
    speed = 5.0 * np.cos(100.0 * time)
    rows = zip(time.tolist(), speed.tolist())
    trace.write_text("time,nut_speed,axial_load\n" + "".join(f"{t!r},{s!r},{load!r}\n" for t, s in rows))
    for name, simulate in [("caged", ef.reference.simulate_caged), ("uncaged", ef.reference.simulate_uncaged)]:
        columns = simulated(
            program, tmp_path, "--scene", name, "--design", "lin-3.6", "--input", str(trace), "--reference", "--force"
        )
        run = simulate(ef.Design.built_in("lin-3.6"), time, speed, load)
        [torque, efficiency] = numbers(columns, "reference_friction_torque", "reference_efficiency")
        np.testing.assert_array_equal(run.friction_torque, torque)
        np.testing.assert_array_equal(run.efficiency, efficiency)


def scenes() -> list[tuple[Any, tuple[npt.NDArray[np.float32], ...]]]:
    """Every scene with a trace of 400 ticks."""
    time = np.arange(400) * 2e-4
    speed = (8.0 * np.sin(60.0 * time)).astype(np.float32)
    load = (1500.0 + 900.0 * np.cos(25.0 * time)).astype(np.float32)
    angle = np.cumsum(speed * np.float32(2e-4), dtype=np.float32)
    design, pressing, bearing = ef.Design.built_in("lin-4.1"), ef.Design.built_in("lin-3.6"), ef.LinearDesign.built_in()
    travel = (0.02 * speed, load, 0.3 * load)
    return [
        (ef.CagedBallScrew(design), (speed, load)),
        (ef.CagedBallScrew(design, branch="rolling"), (speed, load)),
        (ef.CagedBallScrew(design, branch="sliding", friction=0.2), (speed, load)),
        (ef.CagedBallScrewWithMemory(design, reference_load=1500.0), (speed, load, angle)),
        (ef.UncagedBallScrew(pressing), (speed, load)),
        (ef.UncagedBallScrew(pressing, memory_load=1500.0), (speed, load)),
        (ef.LinearBearingTrain(bearing), travel),
        (ef.LinearBearingTrain(bearing, memory_load=1500.0), travel),
    ]


@pytest.mark.parametrize("number", range(8))
def test_ticks_are_the_trace(number: int) -> None:
    scene, trace = scenes()[number]
    one_by_one = scene.copy()
    run = scene.run(*trace)
    for tick, values in enumerate(zip(*trace)):
        outputs = one_by_one.step(*values)
        for name, value in outputs._asdict().items():
            assert getattr(run, name)[tick] == value, (tick, name)
    # The state goes on, a copy stays, and a reset begins anew.
    on = scene.run(*trace)
    friction = next(iter(vars(run)))
    assert not np.array_equal(getattr(on, friction), getattr(run, friction)) or number in (0, 1, 2)
    scene.reset()
    again = scene.run(*trace)
    for name, array in vars(run).items():
        np.testing.assert_array_equal(getattr(again, name), array)
    assert set(np.unique(run.regime)) <= set(ef.Regime)


def test_memory_between_steps() -> None:
    screw = ef.CagedBallScrewWithMemory(ef.Design.built_in("lin-4.1"), reference_load=1000.0)
    angles = np.linspace(0.0, 0.3, 50)
    for angle in angles:
        full = screw.step(5.0, 1000.0, angle)
    back = [screw.between(angle).friction_torque for angle in 0.3 - angles]
    # Friction passes over to the other direction with the angle, and never steeper than it went.
    assert full.friction_torque > 0.0 > back[-1]
    assert np.all(np.diff(back) <= 0.0)
    # Whole turns do not matter: an encoder gives the angle of one.
    first, second = screw.copy(), screw.copy()
    for angle in angles:
        assert first.step(5.0, 1000.0, angle).friction_torque == pytest.approx(
            second.step(5.0, 1000.0, angle + 200.0 * np.pi).friction_torque, rel=1e-3
        )


def test_friction_is_set_while_it_runs() -> None:
    design = ef.Design.built_in("lin-3.6")
    uncaged = ef.UncagedBallScrew(design, friction_range=(0.02, 0.12))
    for screw in [uncaged, ef.CagedBallScrew(design, friction_range=(0.02, 0.12))]:
        before = screw.run(np.full(2000, 5.0), 1500.0).friction_torque[-1]
        screw.set_friction(0.02)
        after = screw.run(np.full(2000, 5.0), 1500.0).friction_torque[-1]
        assert 0.0 < after < 0.5 * before
        with pytest.raises(ef.Error) as error:
            screw.set_friction(0.7)
        assert (error.value.field, error.value.value) == ("friction", pytest.approx(0.7))
        assert screw.run([5.0], 1500.0).friction_torque[0] == pytest.approx(after, rel=1e-2)
    linear = ef.LinearBearingTrain(ef.LinearDesign.built_in())
    before = linear.run(np.full(500, 0.1), 1000.0).friction_force[-1]
    linear.set_friction(0.05)
    assert linear.run(np.full(1, 0.1), 1000.0).friction_force[-1] == pytest.approx(0.5 * before, rel=0.02)


def with_play(design: ef.Design, folder: pathlib.Path) -> ef.Design:
    """The same with play."""
    file = folder / "worn.toml"
    file.write_text(re.sub("clearance = .*", "clearance = 5e-6", design.toml()))
    return ef.Design.read(file)


def test_a_block_is_the_screw(tmp_path: pathlib.Path) -> None:
    design = ef.Design.built_in("lin-4.1")
    folded = ef.fold_design(design)
    assert 0.0 < folded.rms < folded.largest < 0.006 and abs(folded.mean) < folded.rms
    assert folded.states == 2048 and folded.flagged == 0.0 and folded.axial_load == (5.0, 300.0)
    speed, load = np.linspace(-40.0, 40.0, 201), np.linspace(-9000.0, 9000.0, 201)
    by_block = ef.CagedBallScrew.from_block(folded.block)
    torque = ef.CagedBallScrew(design).run(speed, load).friction_torque
    np.testing.assert_array_equal(by_block.run(speed, load).friction_torque, torque)
    # A block of a screw with play takes its place while it runs, and less friction comes of it.
    worn = ef.fold_design(with_play(design, tmp_path))
    by_block.swap_block(worn.block)
    np.testing.assert_array_less(np.abs(by_block.run(speed[1:90], load[1:90]).friction_torque), np.abs(torque[1:90]))
    # What is no block is refused, and the model goes on.
    before = by_block.run(speed, load).friction_torque
    damaged = bytearray(worn.block)
    damaged[100] ^= 1
    for wrong, field in [(bytes(damaged), "checksum"), (worn.block[:-4], "words"), (worn.block[1:], "block"), (b"none", "words")]:
        for take in [ef.CagedBallScrew.from_block, by_block.swap_block]:
            with pytest.raises(ef.Error) as error:
                take(wrong)
            assert error.value.field == field
    np.testing.assert_array_equal(by_block.run(speed, load).friction_torque, before)


def test_a_range_that_no_block_holds_is_refused() -> None:
    design = ef.Design.built_in("lin-4.1")
    with pytest.raises(ef.Error) as error:
        ef.CagedBallScrew(design, friction_range=(0.2, 0.3))
    assert error.value.field == "friction"
    with pytest.raises(ef.Error) as error:
        ef.CagedBallScrew(design).set_friction(0.2)
    assert error.value.field == "friction"


def test_flicker_at_rest_moves_no_friction() -> None:
    step = 2.0 * np.pi / 16384
    # Behind a dead band of the step the nut stands; a turn of one and back is within it.
    counts = np.concatenate([np.arange(0, 600, 10), 590 + np.tile([0, 1, 1, 0, 1], 100)])
    still, moved = (
        ef.CagedBallScrewWithMemory(ef.Design.built_in("lin-4.1"), reference_load=5000.0, encoder_step=size)
        .run(0.0, 5000.0, counts * step)
        .friction_torque[70:]
        for size in (step, 0.0)
    )
    assert np.ptp(still) == 0.0 < np.ptp(moved)
