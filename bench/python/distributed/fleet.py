"""Calibration of a fleet on a Dask cluster: each trace is fitted where it lies, and its numbers come back.

    python fleet.py --traces 10000 --workers 2
    python fleet.py --traces 1000 --workers 2 --kill       # kills a worker on the way
    python fleet.py --traces 1000 --partitions 1,7,64      # the same answer from any partition

Each trace is a drive of its own: inertia and friction scatter from drive to drive, and the fleet's answer is their mean and spread.
A trace is made from its number alone, in the place of a file on a worker's disk.
"""

from __future__ import annotations

import argparse
import os
import signal
import time

import numpy as np
from dask.distributed import Client, LocalCluster, as_completed

# Mean and standard deviation over the fleet: kg m^2, N m s/rad, N m.
FLEET = {"inertia": (4.0e-4, 2.0e-5), "viscous": (2.0e-3, 2.0e-4), "coulomb": (0.12, 0.012)}
NOISE = 2e-3  # N m


def trace(number: int) -> dict[str, np.ndarray]:
    """Four seconds of a drive: a swept angle, and the torque that it takes."""
    random = np.random.Generator(np.random.Philox(key=number))
    inertia, viscous, coulomb = (random.normal(mean, spread) for mean, spread in FLEET.values())
    time_ = np.arange(0.0, 4.0, 2e-3)
    angle = np.zeros_like(time_)
    speed = np.zeros_like(time_)
    acceleration = np.zeros_like(time_)
    for frequency, amplitude in ((0.5, 6.0), (1.7, 1.5), (4.3, 0.25)):
        turn, phase = 2.0 * np.pi * frequency, random.uniform(0.0, 2.0 * np.pi)
        angle += amplitude * np.sin(turn * time_ + phase)
        speed += amplitude * turn * np.cos(turn * time_ + phase)
        acceleration -= amplitude * turn**2 * np.sin(turn * time_ + phase)
    torque = inertia * acceleration + viscous * speed + coulomb * np.sign(speed)
    return {"time": time_, "motor_position": angle, "motor_torque": torque + random.normal(0.0, NOISE, len(time_))}


def part(first: int, count: int) -> str:
    """What a part of the fleet says."""
    import epas_friction

    return epas_friction.merge_sums([epas_friction.trace_sums(trace(number)) for number in range(first, first + count)])


def fleet(client: Client, traces: int, partitions: int, kill: bool = False) -> str:
    """What the whole fleet says, by so many tasks."""
    import epas_friction

    bounds = np.linspace(0, traces, partitions + 1).astype(int)
    tasks = [(int(a), int(b - a)) for a, b in zip(bounds, bounds[1:]) if b > a]
    futures = [client.submit(part, first, count, pure=False) for first, count in tasks]
    found, start = [], time.perf_counter()
    for _, sums in as_completed(futures, with_results=True):
        found.append(sums)
        if kill and len(found) >= max(1, len(tasks) // 3):
            kill, victim = False, min(client.run(os.getpid).values())
            os.kill(victim, signal.SIGKILL)
            print(f"killed worker {victim} after {len(found)} of {len(tasks)} parts", flush=True)
        if len(found) % max(1, len(tasks) // 10) == 0:
            print(f"{len(found)}/{len(tasks)} parts, {time.perf_counter() - start:.0f} s", flush=True)
    # In the order of their arrival: the order does not matter.
    return epas_friction.merge_sums(found)


def shown(sums: str) -> list[str]:
    """Mean and spread of each parameter, to twelve digits."""
    import epas_friction

    return [
        f"{one['name']:10} {one['mean']:.12g} +- {one['spread'] or 0.0:.12g} of {one['traces']} traces"
        for one in epas_friction.population(sums)
    ]


def main() -> None:
    """Reads the arguments."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--traces", type=int, default=10_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--partitions", default="100", help="tasks; several with commas are compared")
    parser.add_argument("--kill", action="store_true", help="kill a worker on the way")
    given = parser.parse_args()
    answers = []
    cluster = LocalCluster(n_workers=given.workers, threads_per_worker=1, dashboard_address=None, processes=True)
    with cluster, Client(cluster) as client:
        client.run(lambda: __import__("epas_friction"))
        for partitions in map(int, given.partitions.split(",")):
            start = time.perf_counter()
            answers.append(shown(fleet(client, given.traces, partitions, given.kill)))
            seconds = time.perf_counter() - start
            print(f"{partitions} partitions: {seconds:.1f} s, {given.traces / seconds / given.workers:.1f} traces a second and worker")
    assert all(answer == answers[0] for answer in answers), "partitions do not agree"
    print("\n".join(answers[0]))


if __name__ == "__main__":
    main()
