"""What functions and scenes return: named arrays. SI units, radians."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum, IntFlag
from typing import Any, NamedTuple, Optional

import numpy as np
import numpy.typing as npt

#: Results in the loop have float32, those of the reference float64.
Array = npt.NDArray[Any]


class Regime(IntEnum):
    """What the mechanism does."""

    STANDING = 0
    DRIVING = 1
    BACK_DRIVING = 2
    LOCKED = 3


class Faults(IntFlag):
    """What was wrong with a tick's inputs, limited in its outputs, or beyond the model.

    ``BEYOND_MODEL`` and ``FORCES_NOT_HELD`` speak of accuracy alone: of the friction, and of forces between balls.
    """

    NONE = 0
    SPEED_NOT_FINITE = 1
    LOAD_NOT_FINITE = 1 << 1
    SPEED_RANGE = 1 << 2
    LOAD_RANGE = 1 << 3
    FRICTION_LIMIT = 1 << 4
    BEYOND_MODEL = 1 << 5
    FORCES_NOT_HELD = 1 << 6
    ANGLE_NOT_VALID = 1 << 7
    TEMPERATURE_RANGE = 1 << 8
    LOAD_STALE = 1 << 9
    TEMPERATURE_STALE = 1 << 10


def words(faults: npt.ArrayLike) -> npt.NDArray[np.str_]:
    """Names of the bits that are set, joined by ``|``; empty where none is.

    Args:
        faults: bits of :class:`Faults`, of any shape.

    Returns:
        ndarray: texts, of the same shape.
    """
    bits, places = np.unique(np.asarray(faults, dtype=np.uint16), return_inverse=True)
    names = ["|".join(str(fault.name) for fault in Faults if fault and fault & int(one)) for one in bits]
    return np.array(names, dtype=np.str_)[places].reshape(np.shape(faults))


class _Flagged:
    """A run with faults."""

    faults: npt.NDArray[np.uint16]

    @property
    def fault_words(self) -> npt.NDArray[np.str_]:
        """Names of the faults of each sample, joined by ``|``; empty where there is none."""
        return words(self.faults)


@dataclass(frozen=True)
class PrincipalCurvature:
    """Principal curvatures of a groove at the contact point, 1/m; the normal points into the metal.

    Attributes:
        kappa1: along the track; above 0 on the screw, below 0 on the nut.
        kappa2: across it; below 0.
    """

    kappa1: Array
    kappa2: Array


@dataclass(frozen=True)
class Ellipse:
    """Contact ellipse of two elastic bodies.

    Attributes:
        axis_ratio: semi-minor over semi-major axis, 0 to 1.
        semi_major: semi-major axis, m.
        semi_minor: semi-minor axis, m.
        deflection: approach of the bodies, m.
        max_pressure: pressure at the centre, Pa.
    """

    axis_ratio: Array
    semi_major: Array
    semi_minor: Array
    deflection: Array
    max_pressure: Array


@dataclass(frozen=True)
class FoldedDesign:
    """A ball screw folded into the constants that firmware evaluates, with the errors of its friction torque.

    Attributes:
        block: the constants, for :meth:`CagedBallScrew.from_block` and a calibration page.
        digest: of everything that was folded.
        friction: least and largest friction coefficient for which it holds.
        axial_load: least and largest axial load of a ball for which it holds, N.
        largest: largest relative error against the exact solver.
        rms: its root mean square.
        mean: its mean, with its sign.
        states: states that were compared, none of them fitted.
        flagged: share of the states that a step flags.
    """

    block: bytes
    digest: str
    friction: tuple[float, float]
    axial_load: tuple[float, float]
    largest: float
    rms: float
    mean: float
    states: int
    flagged: float


@dataclass(frozen=True)
class Efficiency:
    """Closed-form efficiencies of Lin, Velinsky and Ravani 1994; negative where the direction is locked.

    Attributes:
        rolling_screw: the ball rolls, eq. (3).
        sliding_drive: the ball slides, the motor moves the load, eq. (14).
        sliding_backdrive: the ball slides, the load turns the nut, eq. (17).
        loss_drive: 1 - ``sliding_drive``, without the cancellation.
        locked_drive: eq. (16); boolean.
        locked_backdrive: eq. (19); boolean.
    """

    rolling_screw: Array
    sliding_drive: Array
    sliding_backdrive: Array
    loss_drive: Array
    locked_drive: npt.NDArray[np.bool_]
    locked_backdrive: npt.NDArray[np.bool_]


@dataclass(frozen=True)
class ContactSlip:
    """Slip at the centre of one contact.

    Attributes:
        rolling_slip: along the rolling direction, m/s.
        side_slip: across it, m/s.
        spin: about the normal, rad/s.
        entrainment_speed: mean surface speed, m/s.
        entrainment_angle: its direction, rad.
        slide_to_roll: slip over entrainment speed.
        slide_angle: direction of the slip, rad; NaN where nothing slides.
        spin_to_roll: spin times semi-major axis over entrainment speed.
    """

    rolling_slip: Array
    side_slip: Array
    spin: Array
    entrainment_speed: Array
    entrainment_angle: Array
    slide_to_roll: Array
    slide_angle: Array
    spin_to_roll: Array


@dataclass(frozen=True)
class ContactKinematics:
    """Motion of a ball between screw and nut.

    Attributes:
        orbital_speed: of the ball's centre about the axis, rad/s.
        spin_speed: of the ball about its own axis, rad/s.
        screw: contact with the screw.
        nut: contact with the nut.
    """

    orbital_speed: Array
    spin_speed: Array
    screw: ContactSlip
    nut: ContactSlip


@dataclass(frozen=True)
class FrictionMap:
    """Friction of one contact that slips and spins.

    Attributes:
        force: over friction coefficient times load.
        moment: over friction coefficient times load times semi-major axis.
        power: over friction coefficient times load times semi-major axis times the size of the spin.
    """

    force: Array
    moment: Array
    power: Array


class Outputs(NamedTuple):
    """Outputs of a ball screw at one tick.

    Attributes:
        friction_torque: torque about the nut's axis that the motor has to add to overcome friction, N m, with the sign of the speed; with
            memory it keeps the old sign after a reversal, until ``regime`` is ``STANDING`` no more.
        load_torque: torque that holds the load without friction, N m.
        efficiency: work out over work in, in the direction of motion; 0 without a load and while standing, negative where the
            direction is locked.
        regime: what the mechanism does.
        faults: what was wrong.
    """

    friction_torque: float
    load_torque: float
    efficiency: float
    regime: Regime
    faults: Faults


@dataclass(frozen=True)
class Run(_Flagged):
    """Outputs of a ball screw over a trace of ``n`` samples; every array has the shape ``(n,)``.

    Attributes:
        friction_torque: torque about the nut's axis that the motor has to add to overcome friction, N m, with the sign of the speed; with
            memory it keeps the old sign after a reversal, until ``regime`` is ``STANDING`` no more.
        load_torque: torque that holds the load without friction, N m.
        efficiency: work out over work in, in the direction of motion; 0 without a load and while standing, negative where the
            direction is locked.
        regime: a number of :class:`Regime` for each sample.
        faults: bits of :class:`Faults` for each sample.
    """

    friction_torque: npt.NDArray[np.float32]
    load_torque: npt.NDArray[np.float32]
    efficiency: npt.NDArray[np.float32]
    regime: npt.NDArray[np.uint8]
    faults: npt.NDArray[np.uint16]


class UncagedOutputs(NamedTuple):
    """Outputs of a ball screw whose balls press on each other at one tick.

    Attributes:
        friction_torque: the sum of the next two within its limit, N m, with the sign of the speed; with memory the
            old one after a reversal, until ``regime`` is ``STANDING`` no more.
        groove_torque: its part from the grooves, N m.
        ball_torque: its part from balls that rub on each other, N m; with memory it falls with the friction after a reversal.
        load_torque: torque that holds the load without friction, N m.
        contacts: pairs of balls that press on each other.
        largest_contact_force: between two balls, N.
        regime: what the mechanism does.
        faults: what was wrong.
    """

    friction_torque: float
    groove_torque: float
    ball_torque: float
    load_torque: float
    contacts: int
    largest_contact_force: float
    regime: Regime
    faults: Faults


@dataclass(frozen=True)
class UncagedRun(_Flagged):
    """Outputs of a ball screw whose balls press on each other over a trace; every array has the shape ``(n,)``.

    Attributes:
        friction_torque: the sum of the next two within its limit, N m, with the sign of the speed; with memory the
            old one after a reversal, until ``regime`` is ``STANDING`` no more.
        groove_torque: its part from the grooves, N m.
        ball_torque: its part from balls that rub on each other, N m; with memory it falls with the friction after a reversal.
        load_torque: torque that holds the load without friction, N m.
        contacts: pairs of balls that press on each other.
        largest_contact_force: between two balls, N.
        regime: a number of :class:`Regime` for each sample.
        faults: bits of :class:`Faults` for each sample.
    """

    friction_torque: npt.NDArray[np.float32]
    groove_torque: npt.NDArray[np.float32]
    ball_torque: npt.NDArray[np.float32]
    load_torque: npt.NDArray[np.float32]
    contacts: npt.NDArray[np.uint8]
    largest_contact_force: npt.NDArray[np.float32]
    regime: npt.NDArray[np.uint8]
    faults: npt.NDArray[np.uint16]


class LinearOutputs(NamedTuple):
    """Outputs of a linear bearing at one tick.

    Attributes:
        friction_force: the sum of the next two within its limit, N, with the sign of the speed; with memory the
            old one after a reversal, until ``regime`` is ``STANDING`` no more.
        groove_force: its part from the grooves, N.
        ball_force: its part from balls that rub on each other, N; with memory it falls with the friction after a reversal.
        contacts: pairs of balls that press on each other.
        largest_contact_force: between two balls, N.
        regime: ``STANDING`` or ``DRIVING``.
        faults: what was wrong.
    """

    friction_force: float
    groove_force: float
    ball_force: float
    contacts: int
    largest_contact_force: float
    regime: Regime
    faults: Faults


@dataclass(frozen=True)
class LinearRun(_Flagged):
    """Outputs of a linear bearing over a trace; every array has the shape ``(n,)``.

    Attributes:
        friction_force: the sum of the next two within its limit, N, with the sign of the speed; with memory the
            old one after a reversal, until ``regime`` is ``STANDING`` no more.
        groove_force: its part from the grooves, N.
        ball_force: its part from balls that rub on each other, N; with memory it falls with the friction after a reversal.
        contacts: pairs of balls that press on each other.
        largest_contact_force: between two balls, N.
        regime: a number of :class:`Regime` for each sample.
        faults: bits of :class:`Faults` for each sample.
    """

    friction_force: npt.NDArray[np.float32]
    groove_force: npt.NDArray[np.float32]
    ball_force: npt.NDArray[np.float32]
    contacts: npt.NDArray[np.uint8]
    largest_contact_force: npt.NDArray[np.float32]
    regime: npt.NDArray[np.uint8]
    faults: npt.NDArray[np.uint16]


@dataclass(frozen=True)
class ReferenceRun:
    """What the float64 reference says to a trace; arrays have the shape ``(n,)``.

    Attributes:
        friction_torque: torque about the nut's axis that overcomes friction, N m; NaN where no answer was found that meets every balance.
        efficiency: work out over work in.
    """

    friction_torque: npt.NDArray[np.float64]
    efficiency: npt.NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """A parameter's value with its 95 % interval.

    Attributes:
        name: as in a design file.
        unit: empty for a pure number.
        value: estimated, or set.
        low: low end of the interval; not finite where nothing bounds it.
        high: high end.
        fixed: whether it was set instead of estimated.
    """

    name: str
    unit: str
    value: float
    low: float
    high: float
    fixed: bool


@dataclass(frozen=True)
class ModelScore:
    """How a model of friction does on a trace.

    Attributes:
        name: of the model.
        relative_error: error of the effort over the effort, rms.
        relative_error_unseen: the same on what was not fitted.
        relative_error_inverse: residual of the fitted rows over the effort.
        relative_error_inverse_unseen: the same on rows that were not fitted.
        position_error: of the closed loop, rms, rad or m.
        residual_unseen: rms, N m or N.
        information_criterion: Bayes's, less the least one of the models.
        parameters: how many were fitted.
        cycles: modelled cycles of a tick on a Cortex-M4F.
        cycles_estimated: whether they are estimated instead of counted.
        values: its parameters by name.
    """

    name: str
    relative_error: float
    relative_error_unseen: Optional[float]
    relative_error_inverse: float
    relative_error_inverse_unseen: Optional[float]
    position_error: Optional[float]
    residual_unseen: Optional[float]
    information_criterion: float
    parameters: int
    cycles: Optional[int]
    cycles_estimated: bool
    values: dict[str, Estimate]


@dataclass(frozen=True)
class Calibration:
    """What a measured trace tells.

    Attributes:
        parameters: by name.
        residual_rms: N m or N, after the filter of both sides.
        relative_error: residual over effort, rms.
        effective_rows: number of rows that count, with the correlation of the residual.
        cannot_tell: what the trace cannot tell, and what would; a sentence each.
        models: models of friction on the same trace.
        winner: name of the model that does best on what was not fitted.
        time: of the rows that were compared, s, shape ``(m,)``.
        measured: effort there, filtered, N m or N, shape ``(m,)``.
        model: what the fitted model says, shape ``(m,)``.
    """

    parameters: dict[str, Estimate]
    residual_rms: float
    relative_error: float
    effective_rows: float
    cannot_tell: list[str]
    models: list[ModelScore]
    winner: Optional[str]
    time: npt.NDArray[np.float64]
    measured: npt.NDArray[np.float64]
    model: npt.NDArray[np.float64]

    def __getitem__(self, name: str) -> Estimate:
        """A parameter by its name."""
        return self.parameters[name]


class DesignFigures(NamedTuple):
    """What designs do, float32; NaN where there is none."""

    #: Balls under load.
    loaded_balls: Array
    #: On the nut, N m.
    friction_torque: Array
    #: Work out over work in of a nut that moves the load.
    efficiency: Array
    #: Largest contact pressure in either groove, Pa.
    max_pressure: Array
    #: Between two neighbouring balls, N.
    contact_force: Array
