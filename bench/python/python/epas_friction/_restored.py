"""What pickle calls to make an object again: functions that it finds by their names."""

from __future__ import annotations

from typing import Any

from . import _native


def design(*arguments: Any) -> _native.Design:
    return _native._restored_design(*arguments)


def linear_design(*arguments: Any) -> _native.LinearDesign:
    return _native._restored_linear_design(*arguments)


def caged(*arguments: Any) -> _native.CagedBallScrew:
    return _native._restored_caged(*arguments)


def remembering(*arguments: Any) -> _native.CagedBallScrewWithMemory:
    return _native._restored_remembering(*arguments)


def uncaged(*arguments: Any) -> _native.UncagedBallScrew:
    return _native._restored_uncaged(*arguments)


def bearing(*arguments: Any) -> _native.LinearBearingTrain:
    return _native._restored_bearing(*arguments)
