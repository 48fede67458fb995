"""Studies of ball-screw designs as a Polars expression.

>>> import polars as pl
>>> from epas_friction_polars import design_figures
>>> designs = pl.DataFrame({"lead": [7e-3, 10e-3], "preload": [0.0, 30.0]})
>>> designs.with_columns(design_figures(pitch_radius=14.5e-3, ball_radius=2e-3).struct.unnest())
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Union

import polars as pl
from polars.plugins import register_plugin_function

if TYPE_CHECKING:
    Column = Union[str, float, pl.Expr]

__all__ = ["design_figures"]


def _column(value: Column) -> pl.Expr:
    """A name is a column; a number stands for every row."""
    if isinstance(value, str):
        return pl.col(value)
    return value if isinstance(value, pl.Expr) else pl.lit(float(value))


def design_figures(
    *,
    pitch_radius: Column = "pitch_radius",
    lead: Column = "lead",
    ball_radius: Column = "ball_radius",
    conformity: Column = 0.54,
    contact_angle: Column = math.radians(45.0),
    preload: Column = 0.0,
    axial_load: float = 10e3,
    turns: float = 2.5,
    friction: float = 0.1,
    ball_friction: float = 0.1,
    deviation: float = math.radians(1.0),
) -> pl.Expr:
    """Figures of each row's ball screw, of steel, by the exact balls that firmware's constants are folded from.

    Parameters
    ----------
    pitch_radius, lead, ball_radius
        m; a column's name, an expression, or a number for all rows.
    conformity
        Groove radius over ball diameter, above 0.5.
    contact_angle
        rad, 0.05 to 1.5.
    preload
        Load of each contact of an oversized ball in a screw without load, N; 0, or from 1e-3 on.
    axial_load
        N, 1e-3 to 1e7; it opposes the travel.
    turns
        Turns of the track that are filled with balls side by side.
    friction, ball_friction
        Friction coefficient of ball and groove, 1e-3 to 0.5, and of ball and ball, 0 to 0.5.
    deviation
        By which the contact angle at one of two neighbouring balls is off, rad, 0 to 0.2. At 0 no ball presses, and a row takes a
        twentieth of the time: some 1500 rows a second and core, and 75 with the force between balls.

    Returns
    -------
    An expression of structs: ``loaded_balls``, ``friction_torque`` (N m), ``efficiency``, ``max_pressure`` (Pa),
    ``contact_force`` (between two balls, N; null where a ball has no balance) and ``refused``: why a row has no figures
    (field, value, range), null where it has.

    Rolling resistance, about 1 % of the friction, is left out. A row's figures follow from the row alone: any partition of a table, on
    threads or machines, has the same bits.
    """
    inputs = (pitch_radius, lead, ball_radius, conformity, contact_angle, preload)
    return register_plugin_function(
        plugin_path=Path(__file__).parent,
        function_name="design_figures",
        args=[_column(value) for value in inputs],
        kwargs={
            "axial_load": float(axial_load),
            "turns": float(turns),
            "friction": float(friction),
            "ball_friction": float(ball_friction),
            "deviation": float(deviation),
        },
        is_elementwise=True,
    )
