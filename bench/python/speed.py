"""Functions over arrays beside plain numpy versions of the same formulas, written here.

    python speed.py        # prints a table; needs numpy alone beside the package

Each is timed five times in turn with the other, and the best of either counts. Both answers are compared first.
"""

from __future__ import annotations

import time
from typing import Any, Callable

import numpy as np
import numpy.typing as npt

import epas_friction as ef

Array = npt.NDArray[Any]


def curvature(angle: Array, radius: float, lead_angle: float, groove: float, h: float, l: float) -> tuple[Array, Array]:
    """Principal curvatures of the screw's Gothic arch, as a numpy user writes them: arrays of the angle's dtype."""
    kind = angle.dtype.type
    kappa, tau = kind(np.cos(lead_angle) ** 2 / radius), kind(np.sin(lead_angle) * np.cos(lead_angle) / radius)
    groove, h, l = kind(groove), kind(h), kind(l)
    cos, sin = np.cos(angle), np.sin(angle)
    area = 1 + kappa * (h - groove * cos)
    twist, turn = tau * (h * sin - l * cos), tau * (h * cos + l * sin)
    rest = tau * groove - turn
    scale2 = area * area + twist * twist
    h11 = -(area / groove) * scale2
    h22 = kappa * (area * area * cos + twist * (twist * cos - rest * sin)) + (area / groove) * (rest * turn)
    mixed = (area / groove) * turn - kappa * (twist * sin)
    h12 = mixed * mixed * scale2
    half = kind(0.5) * (h22 - h11)
    spread = half + np.sqrt(half * half + h12)
    inverse = 1 / (scale2 * np.sqrt(scale2) * spread)
    return (h22 * spread + h12) * inverse, (h11 * spread - h12) * inverse


def efficiency(lead_angle: Array, contact_angle: float, friction: Any, ratio: float) -> tuple[Array, ...]:
    """Closed forms of Lin, Velinsky and Ravani 1994 and the locked states."""
    kind = lead_angle.dtype.type
    sin, cos = kind(np.sin(contact_angle)), kind(np.cos(contact_angle))
    f = friction if isinstance(friction, np.ndarray) else kind(friction)
    tangent = np.tan(lead_angle)
    secant2 = 1 + tangent * tangent
    root = np.sqrt(cos * cos + tangent * tangent)
    rolling = 1 - f * kind(ratio) * tangent / (tangent * sin + f * tangent * (kind(ratio) - cos))
    loss = f * (secant2 / sin) / (root + f * sin)
    backdrive = 1 - f * (secant2 / root) / (sin + f * root)
    return rolling, 1 - loss, backdrive, loss, f * root >= sin, f * sin >= root


def ellipse(load: Array) -> tuple[Array, ...]:
    """Powers of the load, from the ellipse under 1 N."""
    one = ef.ellipse(1e-3, 0.02, 1.0, 1e11)
    root = np.cbrt(load)
    ratio = np.full_like(load, one.axis_ratio)
    return one.semi_major * root, one.semi_minor * root, one.deflection * root * root, one.max_pressure * root, ratio


def forces(free: Array, impedance: Array, lists: bool = False) -> Array:
    """Forces between the balls of each row: pooling of adjacent violators, which loops over balls: over the elements of the
    arrays, or of Python's lists, which a loop gets through faster."""
    out = np.zeros((free.shape[0], free.shape[1] - 1))
    for row in range(free.shape[0]):
        clusters: list[list[Any]] = []
        speeds, weights = free[row], impedance[row]
        for speed, weight in zip(speeds.tolist(), weights.tolist()) if lists else zip(speeds, weights):
            clusters.append([speed * weight, weight, 1])
            while len(clusters) > 1 and clusters[-2][0] * clusters[-1][1] > clusters[-1][0] * clusters[-2][1]:
                pushed, weight_pushed, balls = clusters.pop()
                clusters[-1] = [clusters[-1][0] + pushed, clusters[-1][1] + weight_pushed, clusters[-1][2] + balls]
        start = 0
        for momentum, weight, balls in clusters:
            stop = start + int(balls)
            push = np.cumsum(impedance[row, start:stop] * (free[row, start:stop] - momentum / weight))
            out[row, start : stop - 1] = push[:-1]
            start = stop
    return out


def best(*calls: Callable[[], Any], rounds: int = 5) -> list[float]:
    """Least time of each call, s; in turn, so that what else the machine does falls on all."""
    times = [float("inf")] * len(calls)
    for _ in range(rounds):
        for place, call in enumerate(calls):
            start = time.perf_counter()
            call()
            times[place] = min(times[place], time.perf_counter() - start)
    return times


def row(name: str, values: int, ours: Callable[[], Any], plain: Callable[[], Any], wanted: float) -> bool:
    """A line of the table; whether the factor is as wanted."""
    one, other = best(ours, plain)
    factor = other / one
    print(f"{name:58} {1e9 * one / values:9.1f} {1e9 * other / values:10.1f} {factor:8.1f} {wanted:7.0f}")
    return factor >= wanted


def main() -> None:
    n = 1_000_000
    random = np.random.default_rng(1)
    section = (0.0165, 0.19, 3.1e-3, 2e-4, 2e-4)
    radius, lead, groove, h, l = section
    print(f"{'':58} {'ns each':>9} {'numpy':>10} {'factor':>8} {'wanted':>7}")
    good = True
    for kind in [np.float32, np.float64]:
        angle = random.uniform(0.1, 1.4, n).astype(kind)
        ours = ef.groove_curvature("screw", radius, lead, angle, groove, h, l)
        plain = curvature(angle, *section)
        # Roundings of some fifty operations in float32.
        np.testing.assert_allclose(ours.kappa1, plain[0], rtol=1e-4)
        np.testing.assert_allclose(ours.kappa2, plain[1], rtol=1e-5)
        name = np.dtype(kind).name
        good &= row(
            f"groove curvature, {n:,} contact angles, {name}", n,
            lambda: ef.groove_curvature("screw", radius, lead, angle, groove, h, l), lambda: curvature(angle, *section), 5,
        )  # fmt: skip
        friction = random.uniform(0.0, 0.5, n).astype(kind)
        drive = ef.efficiency(0.19, 0.7854, friction, 0.16).sliding_drive
        np.testing.assert_allclose(drive, efficiency(kind(0.19), 0.7854, friction, 0.16)[1], atol=2e-6)
        good &= row(
            f"efficiency, {n:,} friction coefficients, {name}", n,
            lambda: ef.efficiency(0.19, 0.7854, friction, 0.16), lambda: efficiency(kind(0.19), 0.7854, friction, 0.16), 5,
        )  # fmt: skip
        leads = random.uniform(0.02, 1.2, n).astype(kind)
        good &= row(
            f"efficiency, {n:,} lead angles, {name}", n,
            lambda: ef.efficiency(leads, 0.7854, 0.1, 0.16), lambda: efficiency(leads, 0.7854, 0.1, 0.16), 5,
        )  # fmt: skip
        load = random.uniform(0.1, 1000.0, n).astype(kind)
        np.testing.assert_allclose(ef.ellipse(1e-3, 0.02, load, 1e11).semi_major, ellipse(load)[0], rtol=1e-6)
        good &= row(f"ellipse, {n:,} loads, {name}", n, lambda: ef.ellipse(1e-3, 0.02, load, 1e11), lambda: ellipse(load), 5)
    rows = 2000
    free, impedance = random.normal(0.0, 1e-3, (rows, 37)), random.uniform(0.5, 2.0, (rows, 37))
    np.testing.assert_allclose(ef.contact_forces(free, impedance), forces(free, impedance), atol=2e-8)
    good &= row(
        f"forces between 37 balls, {rows:,} rows; numpy loops over balls", rows,
        lambda: ef.contact_forces(free, impedance), lambda: forces(free, impedance), 100,
    )  # fmt: skip
    row(
        "the same; a loop over lists of Python", rows,
        lambda: ef.contact_forces(free, impedance), lambda: forces(free, impedance, lists=True), 1,
    )  # fmt: skip
    print("every factor is as wanted" if good else "a factor is below what is wanted")


if __name__ == "__main__":
    main()
