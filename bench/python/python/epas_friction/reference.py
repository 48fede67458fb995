"""The float64 reference beside the functions of the control interrupt: the same arguments, exact results.

It shares no formula with them: a mistake in one shows in the other.
"""

from __future__ import annotations

from ._native import _reference

groove_curvature = _reference.groove_curvature
ellipse = _reference.ellipse
efficiency = _reference.efficiency
contact_kinematics = _reference.contact_kinematics
friction_map = _reference.friction_map
simulate_caged = _reference.simulate_caged
simulate_uncaged = _reference.simulate_uncaged

__all__ = [
    "contact_kinematics",
    "efficiency",
    "ellipse",
    "friction_map",
    "groove_curvature",
    "simulate_caged",
    "simulate_uncaged",
]
