"""Friction of the ball screw of an electric power steering, over numpy arrays.

Everything is computed by the functions that run in the control interrupt, in float32 and bit for bit; the float64 reference
stands beside them in :mod:`epas_friction.reference`. SI units and radians.

Arrays broadcast as in numpy. Arrays of float32 and float64 are read where they lie; others become float64 first. What is
refused is an :class:`Error` with ``field``, ``value``, ``range`` and ``index``.

>>> import epas_friction as ef
>>> screw = ef.CagedBallScrew(ef.Design.built_in("lin-4.1"))
>>> run = screw.run([10.0, 20.0, -20.0], 3000.0)
>>> run.friction_torque.shape
(3,)
"""

from __future__ import annotations

import json
from typing import Any, Mapping

from . import reference
from ._native import (
    __version__,
    CagedBallScrew,
    CagedBallScrewWithMemory,
    Design,
    LinearBearingTrain,
    LinearDesign,
    UncagedBallScrew,
    calibrate,
    circular_groove_curvature,
    contact_forces,
    contact_kinematics,
    design_figures,
    design_names,
    efficiency,
    ellipse,
    eval_json,
    fitted_curvature,
    fold_design,
    friction_map,
    groove_curvature,
    literature_curvature,
    manoeuvre,
    merge_sums,
    population,
    simulate_caged,
    simulate_linear,
    simulate_uncaged,
    trace_sums,
)
from .errors import Error, NumberTypeError, ShapeError
from .results import (
    Calibration,
    ContactKinematics,
    ContactSlip,
    DesignFigures,
    Efficiency,
    Ellipse,
    Estimate,
    Faults,
    FoldedDesign,
    FrictionMap,
    LinearOutputs,
    LinearRun,
    ModelScore,
    Outputs,
    PrincipalCurvature,
    ReferenceRun,
    Regime,
    Run,
    UncagedOutputs,
    UncagedRun,
)

__all__ = [
    "CagedBallScrew",
    "CagedBallScrewWithMemory",
    "Calibration",
    "ContactKinematics",
    "ContactSlip",
    "Design",
    "DesignFigures",
    "Efficiency",
    "Ellipse",
    "Error",
    "Estimate",
    "Faults",
    "FoldedDesign",
    "FrictionMap",
    "LinearBearingTrain",
    "LinearDesign",
    "LinearOutputs",
    "LinearRun",
    "ModelScore",
    "NumberTypeError",
    "Outputs",
    "PrincipalCurvature",
    "ReferenceRun",
    "Regime",
    "Run",
    "ShapeError",
    "UncagedBallScrew",
    "UncagedOutputs",
    "UncagedRun",
    "__version__",
    "calibrate",
    "circular_groove_curvature",
    "contact_forces",
    "contact_kinematics",
    "design_figures",
    "design_names",
    "efficiency",
    "ellipse",
    "eval",
    "eval_json",
    "fitted_curvature",
    "fold_design",
    "friction_map",
    "groove_curvature",
    "literature_curvature",
    "manoeuvre",
    "merge_sums",
    "population",
    "reference",
    "simulate_caged",
    "simulate_linear",
    "simulate_uncaged",
    "trace_sums",
]


def eval(model: str, **fields: Any) -> dict[str, Any]:
    """One evaluation as the command ``eval`` makes it, in the loop and in float64.

    Args:
        model: "groove_curvature", "efficiency", "steady_state", "hertz", "contact_kinematics", "friction_map", "linear_train",
            "static_load", "ball_screw_train", "ball_screw_pair" or "presliding".
        fields: what the model needs; ``epas eval --help`` lists them.

    Returns:
        dict: ``in_loop`` and ``reference``.

    Raises:
        Error: a field that is missing, unknown, or out of its range.
    """
    try:
        request = json.dumps({"id": 0, "model": model, **fields}, default=_plain)
    except TypeError as error:
        raise NumberTypeError(str(error)) from None
    answer: Mapping[str, Any] = json.loads(eval_json(request))
    if "error" in answer:
        field, message = answer["error"]["field"], answer["error"]["message"]
        # Most messages name their field, some only say what is wrong with it.
        raise Error(message if field in message.split() else f"{field}: {message}", field)
    return {"in_loop": answer["in_loop"], "reference": answer["reference"]}


def _plain(value: Any) -> Any:
    """Arrays and numbers of numpy as lists and numbers of Python."""
    try:
        return value.tolist()
    except AttributeError:
        kind = type(value).__name__
        raise TypeError(f"a field is a number, a text, a list or a dict, not {kind}") from None
