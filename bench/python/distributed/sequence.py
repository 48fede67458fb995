"""Designs by their number alone: any part of a study can be made anywhere, and made again."""

from __future__ import annotations

import numpy as np

# Smallest and largest of each column: SI units, rad, N.
RANGES = {
    "pitch_radius": (10e-3, 20e-3),
    "lead": (4e-3, 20e-3),
    "ball_radius": (1.5e-3, 3.2e-3),
    "conformity": (0.515, 0.58),
    "contact_angle": (0.6, 0.95),
    "preload": (1.0, 100.0),
}

# Powers of 1 / x of x^7 = x + 1: additive recurrence of six dimensions (Roberts 2018), which fills a box evenly.
_ROOT = 1.1127756842787055
_STEPS = {name: _ROOT ** -(place + 1) for place, name in enumerate(RANGES)}


def designs(first: int, count: int) -> dict[str, np.ndarray]:
    """Columns, float32, of the designs with the numbers ``first`` to ``first + count - 1``."""
    numbers = np.arange(first, first + count, dtype=np.float64)
    columns = {}
    for name, (least, most) in RANGES.items():
        share = np.modf(0.5 + numbers * _STEPS[name])[0]
        columns[name] = (least + (most - least) * share).astype(np.float32)
    return columns


def digest(first: int, columns: dict[str, np.ndarray]) -> int:
    """A number of all bits of all rows, each with its own number: the sum over rows, so that parts add up in any order."""
    count = len(next(iter(columns.values())))
    rows = np.arange(first, first + count, dtype=np.uint64)
    with np.errstate(over="ignore"):
        mixed = rows * np.uint64(0x9E3779B97F4A7C15)
        for values in columns.values():
            bits = np.ascontiguousarray(values, dtype=np.float32).view(np.uint32).astype(np.uint64)
            mixed = (mixed ^ bits) * np.uint64(0xBF58476D1CE4E5B9)
            mixed ^= mixed >> np.uint64(27)
    return int(np.sum(mixed, dtype=np.uint64))
