"""Memory, interrupts, and objects that go from process to process."""

from __future__ import annotations

import copy
import multiprocessing
import pathlib
import pickle
import subprocess
import sys
import textwrap
from concurrent.futures import ProcessPoolExecutor
from typing import Any, Callable

import numpy as np
import pytest

import epas_friction as ef

HUGE = np.broadcast_to(np.float64(0.1), (10**6, 10**6))
LONG = np.broadcast_to(np.float64(0.1), (10**12,))


@pytest.mark.parametrize(
    "call",
    [
        lambda: ef.efficiency(0.1, 0.7, HUGE, 0.1),
        lambda: ef.ellipse(1e-3, 2e-3, HUGE, 1e11),
        lambda: ef.friction_map(0.5, HUGE),
        lambda: ef.groove_curvature("nut", 0.0165, 0.19, HUGE, 3.1e-3, 2e-4, 2e-4),
        lambda: ef.reference.efficiency(0.1, 0.7, HUGE, 0.1),
        lambda: ef.contact_forces(HUGE[:, :37], np.broadcast_to(1.0, (10**6, 10**6, 37))),
        lambda: ef.friction_map(np.broadcast_to(0.1, (10**10, 1)), np.broadcast_to(0.1, (10**10,))),
        lambda: ef.design_figures(0.0145, 0.007, 0.002, HUGE),
        lambda: ef.Design.built_in("lin-4.1").ellipse("nut", HUGE),
        lambda: ef.CagedBallScrew(ef.Design.built_in("lin-4.1"), branch="sliding").run(LONG, 1.0, allow_faults=True),
        lambda: ef.LinearBearingTrain(ef.LinearDesign.built_in()).run(LONG, 1.0, allow_faults=True),
    ],
)
def test_what_does_not_fit_is_a_memory_error(call: Callable[[], Any]) -> None:
    with pytest.raises(MemoryError, match="unable to allocate|Unable to allocate"):
        call()


INTERRUPTED = """
import os, signal, threading, time
import numpy as np
import epas_friction as ef

lin = ef.Design.built_in("lin-3.6")
time_ = np.arange(60_000) * 1e-3
{setup}
start = None
# A shell starts what runs in its background with the signal ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)

def interrupt():
    global start
    time.sleep({after})
    start = time.perf_counter()
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=interrupt, daemon=True).start()
try:
    {call}
except KeyboardInterrupt:
    print(time.perf_counter() - start)
    {check}
else:
    raise SystemExit("was not interrupted")
"""


@pytest.mark.parametrize(
    ("setup", "call", "check"),
    [
        ("screw = ef.UncagedBallScrew(lin); before = screw.copy()", "screw.run(np.full(20_000_000, 5.0, np.float32), 1500.0)",
         "assert screw.step(5.0, 1500.0) == before.step(5.0, 1500.0)"),
        ("", "ef.fold_design(lin, friction_range=(0.05, 0.15))", ""),
        ("", "ef.reference.simulate_uncaged(lin, time_, 20.0, 1500.0)", ""),
        ("trace = ef.reference.measured_trace('whole')", "ef.calibrate(trace, ef.Design.built_in('lin-4.1'))", ""),
        ("numbers = np.linspace(0.51, 0.6, 10_000_000)",
         "ef.design_figures(0.0145, 0.007, 0.002, numbers)", ""),
        ("angles = np.linspace(0.01, 0.3, 30_000_000, dtype=np.float32)", "ef.efficiency(angles, 0.7, 0.1, 0.1)", ""),
    ],
)  # fmt: skip
def test_ctrl_c_ends_a_long_call(setup: str, call: str, check: str) -> None:
    script = INTERRUPTED.format(setup=setup, call=call, check=check, after=0.2)
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    # A second on a machine that does nothing else.
    assert float(done.stdout) < 10.0, done.stdout


def in_another_process(value: Any) -> Any:
    """The value by a process that has not seen it."""
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        return pool.submit(copy.copy, value).result(timeout=100)


WAYS = [copy.copy, copy.deepcopy, lambda value: pickle.loads(pickle.dumps(value)), in_another_process]


def screws() -> list[tuple[Any, Callable[[Any], Any]]]:
    """Models with something behind them, and what each says next."""
    caged, pressing, bearing = ef.Design.built_in("lin-4.1"), ef.Design.built_in("lin-3.6"), ef.LinearDesign.built_in()
    speed, load = np.linspace(5.0, -5.0, 60), np.full(60, 1500.0)
    folded = ef.CagedBallScrew(caged)
    ranged = ef.CagedBallScrew(caged, friction_range=(0.05, 0.15))
    ranged.set_friction(0.123)
    sliding = ef.CagedBallScrew(caged, branch="sliding", friction=0.08, loaded_balls=50, reversal_speed=0.7)
    sliding.set_friction(0.09)
    row = ef.UncagedBallScrew(pressing, friction=0.08, ball_friction=0.05)
    row.set_nut_angle(0.4)
    row_with_memory = ef.UncagedBallScrew(pressing, memory_load=1500.0)
    row_with_memory.set_friction(0.1)
    train = ef.LinearBearingTrain(bearing, friction=0.12)
    train.set_carriage_position(0.013)
    train.set_friction(0.11)
    train_with_memory = ef.LinearBearingTrain(bearing, memory_load=100.0)
    made: list[tuple[Any, Callable[[Any], Any]]] = []
    for screw in [folded, ranged, sliding, row, row_with_memory]:
        screw.run(speed, load)
        made.append((screw, lambda one: one.run(speed, load)))
    for one in [train, train_with_memory]:
        one.run(speed * 0.01, 200.0)
        made.append((one, lambda one: one.run(speed * 0.01, 200.0)))
    remembering = ef.CagedBallScrewWithMemory(caged, reference_load=1000.0, encoder_step=1e-4)
    angle = np.cumsum(speed) * 1e-3
    remembering.run(speed, load, angle)
    made.append((remembering, lambda one: one.run(speed, load, angle[::-1].copy())))
    return made


@pytest.mark.parametrize("way", WAYS)
def test_models_go_on_where_they_are(way: Callable[[Any], Any]) -> None:
    for model, goes_on in screws():
        again = way(model)
        assert type(again) is type(model) and again is not model
        expected, found = goes_on(model.copy()), goes_on(again)
        for name, values in vars(expected).items():
            assert np.array_equal(values, getattr(found, name)), (type(model), name)


@pytest.mark.parametrize("way", WAYS)
def test_designs_are_the_same(way: Callable[[Any], Any], tmp_path: pathlib.Path) -> None:
    file = tmp_path / "gear.toml"
    file.write_text(ef.Design.built_in("lin-4.1").toml().replace("lin-4.1", "mine"))
    numbers = ef.Design(pitch_radius=0.0165, lead=0.02, ball_radius=2.778e-3, conformity=0.56, contact_angle=0.7854, loaded_balls=37,
                        uncaged={"balls": 37, "turns": 2.4})  # fmt: skip
    designs = [ef.Design.built_in("lin-3.6"), ef.Design.read(file), numbers]
    for design in designs:
        again = way(design)
        assert again.toml() == design.toml() and again.circuit_balls == design.circuit_balls
    linear = way(ef.LinearDesign.built_in())
    assert repr(linear) == repr(ef.LinearDesign.built_in())


@pytest.mark.parametrize("way", WAYS)
def test_results_are_the_same(way: Callable[[Any], Any]) -> None:
    screw = ef.CagedBallScrew(ef.Design.built_in("lin-4.1"), branch="sliding")
    trace = ef.reference.measured_trace("vehicle")
    short = {name: values[:4000] for name, values in trace.items()}
    results: list[Any] = [
        screw.run([1.0, 2.0], 100.0), screw.step(1.0, 2.0), ef.efficiency(0.1, 0.7, [0.1, 0.2], 0.1), ef.Faults(40), ef.Regime(1),
        ef.fold_design(ef.Design.built_in("lin-4.1")), ef.design_figures(0.0145, 0.007, 0.002),
        ef.contact_kinematics(**KINEMATICS), ef.calibrate(short, ef.Design.built_in("lin-4.1"), models=False),
    ]  # fmt: skip
    for value in results:
        again = way(value)
        assert type(again) is type(value)
        assert repr(again) == repr(value)


KINEMATICS: dict[str, float] = {
    "ball_diameter": 4e-3, "pitch_radius": 0.0145, "lead_angle": 0.0767, "groove_radius_screw": 2.16e-3, "groove_radius_nut": 2.16e-3,
    "contact_angle_screw": 0.785, "contact_angle_nut": 0.785, "pitch_angle": 0.05, "yaw_angle": 0.01, "rolling_radius_screw": 2.1e-3,
    "rolling_radius_nut": 2.1e-3, "speed": 20.0, "semi_major_screw": 1e-4, "semi_minor_screw": 2e-5, "semi_major_nut": 1e-4,
    "semi_minor_nut": 2e-5,
}  # fmt: skip


def test_faults_have_words() -> None:
    screw = ef.CagedBallScrew(ef.Design.built_in("lin-4.1"), branch="sliding")
    run = screw.run([1.0, np.nan, 1e6], [1.0, 1e9, 1e9], allow_faults=True)
    assert run.fault_words.shape == (3,) and run.fault_words[0] == ""
    for bits, words in zip(run.faults, run.fault_words):
        assert set(words.split("|")) - {""} == {fault.name for fault in ef.Faults if fault and fault & int(bits)}
    assert "LOAD_RANGE" in run.fault_words[2].split("|") and "SPEED_RANGE" in run.fault_words[2]


def test_version() -> None:
    assert ef.__version__.count(".") == 2
