# What is compiled; the docstrings stand there, with shapes and units.

from os import PathLike
from typing import Any, Literal, Mapping, final

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike
from typing_extensions import Self

from .results import (
    DesignFigures,
    Calibration,
    ContactKinematics,
    Efficiency,
    Ellipse,
    FoldedDesign,
    FrictionMap,
    LinearOutputs,
    LinearRun,
    Outputs,
    PrincipalCurvature,
    ReferenceRun,
    Run,
    UncagedOutputs,
    UncagedRun,
)

__all__ = [
    "CagedBallScrew",
    "CagedBallScrewWithMemory",
    "Design",
    "LinearBearingTrain",
    "LinearDesign",
    "UncagedBallScrew",
    "__version__",
    "_restored_bearing",
    "_restored_caged",
    "_restored_design",
    "_restored_linear_design",
    "_restored_remembering",
    "_restored_uncaged",
    "calibrate",
    "circular_groove_curvature",
    "contact_forces",
    "contact_kinematics",
    "design_figures",
    "design_names",
    "efficiency",
    "ellipse",
    "eval_json",
    "fitted_curvature",
    "fold_design",
    "friction_map",
    "groove_curvature",
    "literature_curvature",
    "manoeuvre",
    "merge_sums",
    "population",
    "reference_contact_kinematics",
    "reference_efficiency",
    "reference_ellipse",
    "reference_friction_map",
    "reference_groove_curvature",
    "reference_measured_trace",
    "reference_simulate_caged",
    "reference_simulate_uncaged",
    "simulate_caged",
    "simulate_linear",
    "simulate_uncaged",
    "trace_sums",
]

__version__: str

_Groove = Literal["screw", "nut"]
_Branch = Literal["contacts", "rolling", "sliding"]
_Single = npt.NDArray[np.float32]

def groove_curvature(
    groove: _Groove,
    pitch_radius: ArrayLike,
    lead_angle: ArrayLike,
    contact_angle: ArrayLike,
    groove_radius: ArrayLike,
    offset_h: ArrayLike,
    offset_l: ArrayLike,
) -> PrincipalCurvature: ...
def ellipse(
    relative_radius_1: ArrayLike, relative_radius_2: ArrayLike, load: ArrayLike, contact_modulus: ArrayLike
) -> Ellipse: ...
def efficiency(
    lead_angle: ArrayLike,
    contact_angle: ArrayLike,
    friction: ArrayLike,
    ball_ratio: ArrayLike,
    rolling_tangent: ArrayLike | None = None,
) -> Efficiency: ...
def friction_map(axis_ratio: ArrayLike, offset: ArrayLike) -> FrictionMap: ...
def contact_kinematics(
    *,
    ball_diameter: ArrayLike,
    pitch_radius: ArrayLike,
    lead_angle: ArrayLike,
    groove_radius_screw: ArrayLike,
    groove_radius_nut: ArrayLike,
    contact_angle_screw: ArrayLike,
    contact_angle_nut: ArrayLike,
    pitch_angle: ArrayLike,
    yaw_angle: ArrayLike,
    rolling_radius_screw: ArrayLike,
    rolling_radius_nut: ArrayLike,
    speed: ArrayLike,
    semi_major_screw: ArrayLike,
    semi_minor_screw: ArrayLike,
    semi_major_nut: ArrayLike,
    semi_minor_nut: ArrayLike,
) -> ContactKinematics: ...
def reference_groove_curvature(
    groove: _Groove,
    pitch_radius: ArrayLike,
    lead_angle: ArrayLike,
    contact_angle: ArrayLike,
    groove_radius: ArrayLike,
    offset_h: ArrayLike,
    offset_l: ArrayLike,
) -> PrincipalCurvature: ...
def reference_ellipse(
    relative_radius_1: ArrayLike, relative_radius_2: ArrayLike, load: ArrayLike, contact_modulus: ArrayLike
) -> Ellipse: ...
def reference_efficiency(
    lead_angle: ArrayLike,
    contact_angle: ArrayLike,
    friction: ArrayLike,
    ball_ratio: ArrayLike,
    rolling_tangent: ArrayLike | None = None,
) -> Efficiency: ...
def reference_friction_map(axis_ratio: ArrayLike, offset: ArrayLike) -> FrictionMap: ...
def reference_contact_kinematics(
    *,
    ball_diameter: ArrayLike,
    pitch_radius: ArrayLike,
    lead_angle: ArrayLike,
    groove_radius_screw: ArrayLike,
    groove_radius_nut: ArrayLike,
    contact_angle_screw: ArrayLike,
    contact_angle_nut: ArrayLike,
    pitch_angle: ArrayLike,
    yaw_angle: ArrayLike,
    rolling_radius_screw: ArrayLike,
    rolling_radius_nut: ArrayLike,
    speed: ArrayLike,
    semi_major_screw: ArrayLike,
    semi_minor_screw: ArrayLike,
    semi_major_nut: ArrayLike,
    semi_minor_nut: ArrayLike,
) -> ContactKinematics: ...
def reference_measured_trace(
    course: Literal["vehicle", "rig", "whole"] = "vehicle", *, seed: int = 0
) -> dict[str, npt.NDArray[np.float64]]: ...
def reference_simulate_caged(
    design: Design, time: ArrayLike, nut_speed: ArrayLike, axial_load: ArrayLike
) -> ReferenceRun: ...
def reference_simulate_uncaged(
    design: Design, time: ArrayLike, nut_speed: ArrayLike, axial_load: ArrayLike
) -> ReferenceRun: ...
def fitted_curvature(
    groove: _Groove,
    pitch_radius: ArrayLike,
    lead_angle: ArrayLike,
    contact_angle: ArrayLike,
    groove_radius: ArrayLike,
    offset_h: ArrayLike,
    offset_l: ArrayLike,
) -> _Single: ...
def circular_groove_curvature(
    groove: _Groove, pitch_radius: ArrayLike, lead_angle: ArrayLike, contact_angle: ArrayLike, groove_radius: ArrayLike
) -> _Single: ...
def literature_curvature(
    groove: _Groove, pitch_radius: ArrayLike, contact_angle: ArrayLike, ball_radius: ArrayLike
) -> _Single: ...
def contact_forces(free_speed: ArrayLike, impedance: ArrayLike) -> _Single: ...
def design_names() -> list[str]: ...
def eval_json(request: str) -> str: ...
def manoeuvre(
    name: Literal["parking", "weave", "kerb", "turns"], design: Design
) -> list[npt.NDArray[np.float64]]: ...
def simulate_caged(
    design: Design, time: ArrayLike, nut_speed: ArrayLike, axial_load: ArrayLike, *, memory: bool = False
) -> Run: ...
def simulate_uncaged(
    design: Design, time: ArrayLike, nut_speed: ArrayLike, axial_load: ArrayLike, *, memory: bool = False
) -> UncagedRun: ...
def simulate_linear(
    design: LinearDesign,
    time: ArrayLike,
    speed: ArrayLike,
    normal_load: ArrayLike,
    side_load: ArrayLike,
    *,
    memory: bool = False,
) -> LinearRun: ...
def calibrate(
    trace: Mapping[str, ArrayLike],
    design: Design | None = None,
    *,
    ratio: float | None = None,
    estimate: list[str] | None = None,
    fix: Mapping[str, float] | None = None,
    models: bool = True,
    validate: Mapping[str, ArrayLike] | None = None,
    controller: tuple[float, float] | None = None,
) -> Calibration: ...

def design_figures(
    pitch_radius: ArrayLike,
    lead: ArrayLike,
    ball_radius: ArrayLike,
    conformity: ArrayLike | None = None,
    contact_angle: ArrayLike | None = None,
    preload: ArrayLike | None = None,
    *,
    axial_load: float | None = None,
    turns: float | None = None,
    friction: float | None = None,
    ball_friction: float | None = None,
    deviation: float | None = None,
    strict: bool = True,
) -> DesignFigures: ...
def trace_sums(
    trace: Mapping[str, ArrayLike],
    design: Design | None = None,
    *,
    ratio: float | None = None,
) -> str: ...
def merge_sums(parts: list[str]) -> str: ...
def population(sums: str) -> list[dict[str, Any]]: ...
def fold_design(
    design: Design,
    *,
    friction_range: tuple[float, float] | None = None,
    axial_load: tuple[float, float] | None = None,
    seed: int | None = None,
) -> FoldedDesign: ...

@final
class Design:
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, _memo: object) -> Self: ...
    def __new__(cls, **keys: Any) -> Self: ...
    @staticmethod
    def built_in(name: str) -> Design: ...
    @staticmethod
    def read(path: str | PathLike[str]) -> Design: ...
    @property
    def name(self) -> str: ...
    @property
    def pitch_radius(self) -> float: ...
    @property
    def lead(self) -> float: ...
    @property
    def lead_angle(self) -> float: ...
    @property
    def ball_radius(self) -> float: ...
    @property
    def contact_angle(self) -> float: ...
    @property
    def friction(self) -> float: ...
    @property
    def clearance(self) -> float: ...
    @property
    def loaded_balls(self) -> int: ...
    @property
    def circuit_balls(self) -> int | None: ...
    def toml(self) -> str: ...
    def ellipse(self, groove: _Groove, load: ArrayLike) -> Ellipse: ...

@final
class LinearDesign:
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, _memo: object) -> Self: ...
    def __new__(cls, **keys: Any) -> Self: ...
    @staticmethod
    def built_in() -> LinearDesign: ...
    @staticmethod
    def read(path: str | PathLike[str]) -> LinearDesign: ...
    @property
    def name(self) -> str: ...
    @property
    def balls(self) -> int: ...
    @property
    def ball_radius(self) -> float: ...
    @property
    def friction(self) -> float: ...

@final
class CagedBallScrew:
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, _memo: object) -> Self: ...
    def __new__(cls, design: Design, *, friction: float | None = None, friction_range: tuple[float, float] | None = None, branch: _Branch | None = None, loaded_balls: int | None = None, reversal_speed: float | None = None) -> Self: ...
    @staticmethod
    def from_block(block: bytes) -> CagedBallScrew: ...
    def swap_block(self, block: bytes) -> None: ...
    def step(self, nut_speed: float, axial_load: float) -> Outputs: ...
    def run(self, nut_speed: ArrayLike, axial_load: ArrayLike, *, allow_faults: bool = False) -> Run: ...
    def reset(self) -> None: ...
    def set_friction(self, friction: float) -> None: ...
    @property
    def faulted_ticks(self) -> int: ...
    def copy(self) -> CagedBallScrew: ...

@final
class CagedBallScrewWithMemory:
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, _memo: object) -> Self: ...
    def __new__(cls, design: Design, *, reference_load: float, encoder_step: float = 0.0) -> Self: ...
    def step(self, nut_speed: float, axial_load: float, nut_angle: float) -> Outputs: ...
    def run(self, nut_speed: ArrayLike, axial_load: ArrayLike, nut_angle: ArrayLike, *, allow_faults: bool = False) -> Run: ...
    def reset(self) -> None: ...
    def between(self, nut_angle: float) -> Outputs: ...
    @property
    def faulted_ticks(self) -> int: ...
    def copy(self) -> CagedBallScrewWithMemory: ...

@final
class UncagedBallScrew:
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, _memo: object) -> Self: ...
    def __new__(
        cls,
        design: Design,
        *,
        tick: float = 2e-4,
        friction: float | None = None,
        friction_range: tuple[float, float] | None = None,
        ball_friction: float | None = None,
        memory_load: float | None = None,
    ) -> Self: ...
    @staticmethod
    def from_block(design: Design, block: bytes, *, tick: float = 2e-4, ball_friction: float | None = None) -> UncagedBallScrew: ...
    def step(self, nut_speed: float, axial_load: float) -> UncagedOutputs: ...
    def run(self, nut_speed: ArrayLike, axial_load: ArrayLike, *, allow_faults: bool = False) -> UncagedRun: ...
    def reset(self) -> None: ...
    def set_friction(self, friction: float) -> None: ...
    def set_nut_angle(self, angle: float) -> None: ...
    def pressing(self) -> list[int]: ...
    @property
    def balls(self) -> int: ...
    @property
    def tick(self) -> float: ...
    @property
    def faulted_ticks(self) -> int: ...
    def copy(self) -> UncagedBallScrew: ...

@final
class LinearBearingTrain:
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, _memo: object) -> Self: ...
    def __new__(cls, design: LinearDesign, *, tick: float = 2e-4, friction: float | None = None, ball_friction: float | None = None, memory_load: float | None = None) -> Self: ...
    def step(self, speed: float, normal_load: float, side_load: float = 0.0) -> LinearOutputs: ...
    def run(self, speed: ArrayLike, normal_load: ArrayLike, side_load: ArrayLike | None = None, *, allow_faults: bool = False) -> LinearRun: ...
    def reset(self) -> None: ...
    def set_friction(self, friction: float) -> None: ...
    def set_carriage_position(self, position: float) -> None: ...
    def pressing(self) -> list[int]: ...
    @property
    def balls(self) -> int: ...
    @property
    def tick(self) -> float: ...
    @property
    def faulted_ticks(self) -> int: ...
    def copy(self) -> LinearBearingTrain: ...

_Made = tuple[tuple[str, str | None], float, float | None, float | None, float | None, float | None]

def _restored_design(name: str, text: str | None) -> Design: ...
def _restored_linear_design(name: str, text: str | None) -> LinearDesign: ...
def _restored_caged(block: bytes | None, text: str | None, friction: float | None, state: bytes) -> CagedBallScrew: ...
def _restored_remembering(name: str, text: str | None, made: tuple[float, float], block: bytes, state: bytes) -> CagedBallScrewWithMemory: ...
def _restored_uncaged(made: _Made, block: bytes, state: bytes) -> UncagedBallScrew: ...
def _restored_bearing(made: _Made, state: bytes) -> LinearBearingTrain: ...
