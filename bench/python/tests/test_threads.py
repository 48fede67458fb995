"""Other threads run while a trace does, and arrays that fit are not copied."""

from __future__ import annotations

import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import epas_friction as ef


def test_other_threads_run_meanwhile() -> None:
    screw = ef.UncagedBallScrew(ef.Design.built_in("lin-3.6"))
    speed = np.full(400_000, 5.0, dtype=np.float32)
    ticks: list[float] = []
    done = threading.Event()

    def count() -> None:
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(1e-3)

    thread = threading.Thread(target=count)
    thread.start()
    start = time.perf_counter()
    screw.run(speed, 1500.0)
    end = time.perf_counter()
    done.set()
    thread.join()
    # With the lock held the other thread would stand from the start to the end.
    between = [tick for tick in ticks if start + 0.1 * (end - start) < tick < end - 0.1 * (end - start)]
    assert end - start > 0.02
    assert len(between) >= 3, f"{len(between)} ticks in {end - start:.3f} s"


def test_two_threads_do_not_share_a_model() -> None:
    screw = ef.UncagedBallScrew(ef.Design.built_in("lin-3.6"))
    speed = np.full(400_000, 5.0, dtype=np.float32)
    thread = threading.Thread(target=screw.run, args=(speed, 1500.0))
    thread.start()
    time.sleep(5e-3)
    try:
        with pytest.raises(RuntimeError, match="[Bb]orrowed"):
            while thread.is_alive():
                screw.step(5.0, 1500.0)
    finally:
        thread.join()
    screw.step(5.0, 1500.0)


PEAK = """
import resource, sys
import numpy as np
import epas_friction as ef

def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024

kind, n = sys.argv[1], 8_000_000
screw = ef.CagedBallScrew(ef.Design.built_in("lin-4.1"), branch="sliding")
speed, load = np.full(n, 5.0, dtype=kind), np.full(n, 1e3, dtype=kind)
screw.run(speed[:10], load[:10])
before = peak()
run = screw.run(speed, load)
print(peak() - before - sum(array.nbytes for array in vars(run).values()))
"""


@pytest.mark.parametrize("kind", ["float32", "float64"])
def test_arrays_that_fit_are_not_copied(kind: str) -> None:
    done = subprocess.run([sys.executable, "-c", PEAK, kind], capture_output=True, text=True, check=True)
    # Memory beyond the results: a copy of one of the two inputs in float32 would be 32 MB. Pages and the allocator's own: measured
    # below 0.5 MB.
    assert int(done.stdout) < 8_000_000
