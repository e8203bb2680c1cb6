"""What can go wrong, as exceptions. All are FpzError and one of Python's own kinds."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Any


class FpzError(Exception):
    """Everything that this module raises on its own account."""


class InputError(FpzError, ValueError):
    """An input that is not right. One line per problem, with its place and a way out."""


class OutputError(FpzError, OSError):
    """A file that cannot be written."""


class UpdateError(FpzError, RuntimeError):
    """An update that failed. The state is the one before it.

    status: "snap_back", "non_convergence", ...; index: of the point in a batch, else None.
    """

    def __init__(self, message: str, status: str = "", index: int | None = None) -> None:
        super().__init__(message)
        self.status = status
        self.index = index


class RunError(FpzError, RuntimeError):
    """A path, fit or scene that did not come through; `result` is what there is of it."""

    def __init__(self, message: str, result: Any = None) -> None:
        super().__init__(message)
        self.result = result


class FpzWarning(UserWarning):
    """Something admissible that is probably a slip."""


def warn(lines: list[str]) -> None:
    """Each line as an FpzWarning at the first line of the call stack that is not of this package."""
    here, level, frame = os.path.dirname(__file__), 1, sys._getframe()
    while frame is not None and os.path.dirname(frame.f_code.co_filename) == here:
        level, frame = level + 1, frame.f_back
    for line in lines:
        warnings.warn(line, FpzWarning, stacklevel=level)
