"""Exceptions: what was refused, with field, value and allowed range."""

from __future__ import annotations

from typing import Optional


class Error(ValueError):
    """A value that is refused.

    Attributes:
        field: name of the argument, or of the key in a design; ``None`` where no single one is to blame.
        value: the value found, in the field's own unit; ``None`` where it is not a number.
        range: smallest and largest allowed value; ``None`` where the reason is another.
        index: place in the broadcast arrays; ``None`` outside arrays.
    """

    field: Optional[str]
    value: Optional[float]
    range: Optional[tuple[float, float]]
    index: Optional[tuple[int, ...]]

    def __init__(
        self,
        message: str,
        field: Optional[str] = None,
        value: Optional[float] = None,
        range: Optional[tuple[float, float]] = None,
        index: Optional[tuple[int, ...]] = None,
    ) -> None:
        super().__init__(message)
        self.field = field
        self.value = value
        self.range = range
        self.index = index

    def __reduce__(self) -> tuple[type[Error], tuple[object, ...]]:
        # Exceptions go from process to process, with what they carry.
        return type(self), (str(self), self.field, self.value, self.range, self.index)


class NumberTypeError(Error, TypeError):
    """An argument that is not a number and no array of numbers."""


class ShapeError(Error):
    """Arrays whose shapes do not fit to each other."""
