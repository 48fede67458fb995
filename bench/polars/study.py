"""Many designs by a Polars expression, the same rows again in other parts, and the force between balls of the best.

    python study.py --designs 100000
"""

from __future__ import annotations

import argparse
import math
import time

import polars as pl

from epas_friction_polars import design_figures

RANGES = {
    "pitch_radius": (10e-3, 20e-3),
    "lead": (4e-3, 20e-3),
    "ball_radius": (1.5e-3, 3.2e-3),
    "conformity": (0.515, 0.58),
    "contact_angle": (0.6, 0.95),
    "preload": (1.0, 100.0),
}
# Powers of 1 / x of x^7 = x + 1: additive recurrence of six dimensions (Roberts 2018), which fills a box evenly.
ROOT = 1.1127756842787055


def designs(first: int, count: int) -> pl.LazyFrame:
    """Designs by their numbers."""
    number = pl.int_range(first, first + count, dtype=pl.Int64).alias("number")
    share = {name: (0.5 + pl.col("number") * ROOT ** -(place + 1)) % 1.0 for place, name in enumerate(RANGES)}
    columns = [
        (least + (most - least) * share[name]).cast(pl.Float32).alias(name) for name, (least, most) in RANGES.items()
    ]
    return pl.LazyFrame().select(number).with_columns(columns)


def studied(frame: pl.LazyFrame, deviation: float = 0.0) -> pl.LazyFrame:
    """Figures beside the designs; balls press on each other where there is a deviation, rad."""
    figures = design_figures(**{name: name for name in RANGES}, deviation=deviation)
    return frame.with_columns(figures.alias("figures")).unnest("figures")


def main() -> None:
    """Reads the arguments."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--designs", type=int, default=100_000)
    parser.add_argument("--best", type=int, default=100, help="designs whose balls are looked at pressing")
    given = parser.parse_args()
    start = time.perf_counter()
    whole = studied(designs(0, given.designs)).collect(engine="streaming").sort("number")
    seconds = time.perf_counter() - start
    print(f"{given.designs} designs in {seconds:.1f} s on {pl.thread_pool_size()} threads: {given.designs / seconds:.0f} a second")
    few = min(given.designs, 5_000)
    parts = pl.concat([studied(designs(first, min(777, few - first))).collect() for first in range(0, few, 777)])
    assert parts.equals(whole.head(few)), "parts and whole do not agree"
    print(f"the first {few} rows again, in parts of 777: the same to the bit")
    known = whole.filter(pl.col("efficiency").is_not_null())
    best = known.top_k(given.best, by="efficiency").select("number", *RANGES)
    start = time.perf_counter()
    pressing = studied(best.lazy(), math.radians(1.0)).collect(engine="streaming").sort("efficiency", descending=True)
    print(f"force between balls of the best {given.best}: {time.perf_counter() - start:.1f} s")
    print(pressing.head(3).select("number", "lead", "preload", "friction_torque", "efficiency", "max_pressure", "contact_force"))
    print(whole.select(pl.col("refused").is_not_null().sum(), pl.col("friction_torque").is_null().sum().alias("no torque")))
    print(pressing.select(pl.col("contact_force").is_null().sum().alias("no force")))


if __name__ == "__main__":
    main()
