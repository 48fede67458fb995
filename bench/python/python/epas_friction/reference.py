"""The float64 reference beside the functions of the control interrupt: the same arguments, exact results.

It shares no formula with them: a mistake in one shows in the other.
"""

from __future__ import annotations

from ._native import (
    reference_contact_kinematics,
    reference_efficiency,
    reference_ellipse,
    reference_friction_map,
    reference_groove_curvature,
    reference_measured_trace,
    reference_simulate_caged,
    reference_simulate_uncaged,
)

contact_kinematics = reference_contact_kinematics
efficiency = reference_efficiency
ellipse = reference_ellipse
friction_map = reference_friction_map
groove_curvature = reference_groove_curvature
measured_trace = reference_measured_trace
simulate_caged = reference_simulate_caged
simulate_uncaged = reference_simulate_uncaged

__all__ = [
    "contact_kinematics",
    "efficiency",
    "ellipse",
    "friction_map",
    "groove_curvature",
    "measured_trace",
    "simulate_caged",
    "simulate_uncaged",
]
