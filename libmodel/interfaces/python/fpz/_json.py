"""Python objects as the JSON text that the library reads."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from typing import Any

import numpy

from ._errors import InputError


def _plain(value: Any, place: str) -> Any:
    """The value in dictionaries, lists, numbers and strings; numpy's and pathlib's kinds are converted."""
    if isinstance(value, Mapping):
        return {str(k): _plain(v, f"{place}.{k}" if place else str(k)) for k, v in value.items()}
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(v, f"{place}[{k}]") for k, v in enumerate(value)]
    if isinstance(value, float) and not math.isfinite(value):
        raise InputError(f"{place}: {value} is not a number that a file can hold")
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    raise InputError(f"{place}: a {type(value).__name__} is neither a number nor text, a list or a dictionary")


def text_of(value: Any) -> str:
    """JSON text on one line. Raises InputError naming the place of what JSON cannot say (NaN, other objects)."""
    return json.dumps(_plain(value, ""))
