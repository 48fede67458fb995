"""A study of designs on a Dask cluster: torque, efficiency and pressure of each, and the force between balls of the best.

    python designs.py --designs 100000 --workers 2 --output study
    python designs.py --designs 20000 --workers 2 --kill           # kills a worker on the way
    python designs.py --designs 20000 --scaling                    # one worker against two

The force takes twenty times as long as all the rest, so that it is left for the best one.
Every block of designs is written as soon as it is there, and a study that was stopped goes on where it was.
"""

from __future__ import annotations

import argparse
import os
import signal
import tempfile
import time
from pathlib import Path

import numpy as np
from dask.distributed import Client, LocalCluster, as_completed

from sequence import designs, digest

FIGURES = ("friction_torque", "efficiency", "max_pressure")


def block(first: int, count: int, folder: str) -> dict:
    """Figures of a block of designs, from its file or computed and written; what they say together."""
    import epas_friction

    path = Path(folder) / f"designs-{first:012}-{count}.npz"
    if path.exists():
        figures = dict(np.load(path))
    else:
        found = epas_friction.design_figures(**designs(first, count), deviation=0.0, strict=False)
        figures = {name: np.asarray(getattr(found, name)) for name in FIGURES}
        with tempfile.NamedTemporaryFile(dir=folder, suffix=".part", delete=False) as file:
            np.savez(file, **figures)
        os.replace(file.name, path)
    return summary(first, figures)


def summary(first: int, figures: dict[str, np.ndarray]) -> dict:
    """What a block says, in numbers that merge exactly: counts, extremes, and a digest of all bits."""
    known = {name: values[np.isfinite(values)] for name, values in figures.items()}
    efficiency = np.nan_to_num(figures["efficiency"], nan=-1.0)
    best = int(np.argmax(efficiency))
    return {
        "designs": len(efficiency),
        "with_figures": len(known["friction_torque"]),
        "least": {name: float(values.min(initial=np.inf)) for name, values in known.items()},
        "most": {name: float(values.max(initial=-np.inf)) for name, values in known.items()},
        # Of equally good designs the one with the lowest number.
        "best": (float(efficiency[best]), -(first + best)),
        "digest": digest(first, figures),
    }


def merged(one: dict, other: dict) -> dict:
    """What two parts say together."""
    return {
        "designs": one["designs"] + other["designs"],
        "with_figures": one["with_figures"] + other["with_figures"],
        "least": {name: min(one["least"][name], other["least"][name]) for name in FIGURES},
        "most": {name: max(one["most"][name], other["most"][name]) for name in FIGURES},
        "best": max(one["best"], other["best"]),
        "digest": (one["digest"] + other["digest"]) % 2**64,
    }


def study(client: Client, count: int, size: int, folder: str, kill: bool = False) -> dict:
    """Runs the blocks of a study on the workers of a cluster."""
    blocks = [(first, min(size, count - first)) for first in range(0, count, size)]
    futures = [client.submit(block, first, rows, folder, pure=False) for first, rows in blocks]
    whole, done, start = None, 0, time.perf_counter()
    for _, found in as_completed(futures, with_results=True):
        whole = found if whole is None else merged(whole, found)
        done += 1
        if kill and done == max(1, len(blocks) // 3):
            kill, victim = False, min(client.run(os.getpid).values())
            os.kill(victim, signal.SIGKILL)
            print(f"killed worker {victim} after {done} of {len(blocks)} blocks", flush=True)
        if done % max(1, len(blocks) // 20) == 0:
            elapsed = time.perf_counter() - start
            left = elapsed / done * (len(blocks) - done)
            print(f"{done}/{len(blocks)} blocks, {whole['designs'] / elapsed:.0f} designs/s, {left:.0f} s left", flush=True)
    return whole


def timed(workers: int, count: int, size: int, folder: str, kill: bool = False) -> tuple[dict, float]:
    """A study on a local cluster; seconds without the start of the cluster."""
    cluster = LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None, processes=True)
    with cluster, Client(cluster) as client:
        client.run(lambda: __import__("epas_friction"))
        start = time.perf_counter()
        found = study(client, count, size, folder, kill)
        return found, time.perf_counter() - start


def scaling(count: int, size: int) -> None:
    """Throughput of one worker and of two, and what it means for 1e9 designs."""
    rates, answers = [], []
    for workers in (1, 2):
        with tempfile.TemporaryDirectory() as folder:
            found, seconds = timed(workers, count, size, folder)
        rates.append(count / seconds)
        answers.append(found)
        print(f"{workers} worker(s): {count / seconds:.0f} designs/s")
    assert answers[0] == answers[1], "one worker and two do not agree"
    print(f"two over one: {rates[1] / rates[0]:.2f}")
    hours = 1e9 / rates[0] / 3600.0
    print(f"1e9 designs: {hours:.0f} core-hours, {hours / 100:.1f} h on 100 cores if blocks go on as from one worker to two")


def main() -> None:
    """Reads the arguments."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--designs", type=int, default=100_000)
    parser.add_argument("--block", type=int, default=1_000, help="designs in a task")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--output", help="folder of the figures [default: a temporary one]")
    parser.add_argument("--kill", action="store_true", help="kill a worker on the way")
    parser.add_argument("--scaling", action="store_true", help="one worker against two")
    given = parser.parse_args()
    if given.scaling:
        scaling(given.designs, given.block)
        return
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.output or temporary
        Path(folder).mkdir(parents=True, exist_ok=True)
        found, seconds = timed(given.workers, given.designs, given.block, folder, given.kill)
    print(f"{found['designs']} designs in {seconds:.1f} s, {found['designs'] / seconds / given.workers:.0f} a second and worker")
    print(f"with figures: {found['with_figures']}; digest {found['digest']:016x}")
    for name in FIGURES:
        print(f"{name:16} {found['least'][name]:.4g} to {found['most'][name]:.4g}")
    efficiency, number = found["best"]
    best = {name: float(values[0]) for name, values in designs(-number, 1).items()}
    print(f"best efficiency {efficiency:.4f}, design {-number}: {best}")
    import epas_friction

    print(f"force between its balls {float(epas_friction.design_figures(**best).contact_force):.4g} N")


if __name__ == "__main__":
    main()
