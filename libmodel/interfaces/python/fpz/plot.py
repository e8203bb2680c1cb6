"""Pictures of results, with matplotlib (Debian: python3-matplotlib), which is imported when one is drawn.

Every function draws into the given axes, or into a new figure's, and returns the axes.
"""

from __future__ import annotations

from typing import Any, Union

import numpy

from ._core import Material
from ._runs import CalibrationResult, PathResult, SceneResult

__all__ = ["calibration", "crack", "frame", "history", "yield_surface"]

Axes = Any  # matplotlib.axes.Axes, which may not be there


def _axes(axes: Axes) -> Axes:
    if axes is not None:
        return axes
    import matplotlib.pyplot as pyplot

    return pyplot.subplots()[1]


def history(
    result: Union[PathResult, SceneResult, numpy.ndarray], x: str, *columns: str, axes: Axes = None, **line: Any
) -> Axes:
    """Columns of a history over column `x`, SI. Keywords go to matplotlib's plot()."""
    rows = result if isinstance(result, numpy.ndarray) else result.history
    axes = _axes(axes)
    for name in (x, *columns):
        if name not in (rows.dtype.names or ()):
            raise ValueError(f'no column "{name}"; there are {", ".join(rows.dtype.names or ())}')
    for name in columns:
        axes.plot(rows[x], rows[name], **{"label": name, **line})
    axes.set_xlabel(x)
    axes.set_ylabel(", ".join(columns))
    if len(columns) > 1:
        axes.legend()
    return axes


def yield_surface(material: Material, axes: Axes = None, integrity: float = 1.0, **line: Any) -> Axes:
    """Normal (x) and shear traction (y), Pa, at which a zone of that integrity yields (eq 48)."""
    p = material.parameters
    slope = numpy.tan(numpy.radians(p["friction_angle_deg"]))
    tip = p["cohesion"] - p["tensile_strength"] * slope
    normal = integrity * numpy.linspace(-2.0 * p["cohesion"], p["tensile_strength"], 400)
    reach = integrity * p["cohesion"] - normal * slope
    shear = numpy.sqrt(numpy.maximum(reach**2 - (integrity * tip) ** 2, 0.0))
    axes = _axes(axes)
    axes.plot(numpy.r_[normal, normal[::-1]], numpy.r_[shear, -shear[::-1]], **line)
    axes.set_xlabel("normal traction, Pa")
    axes.set_ylabel("shear traction, Pa")
    return axes


def calibration(result: CalibrationResult, name: str | None = None, axes: Axes = None) -> Axes:
    """Measured and predicted values of a data set (the first one, or the named), with the confidence band; SI."""
    curve = result.curves[name if name is not None else next(iter(result.curves))]
    axes = _axes(axes)
    axes.plot(curve["abscissa"], curve["measured"], "o", markersize=3, label="measured")
    (fitted,) = axes.plot(curve["abscissa"], curve["predicted"], label="fitted")
    low, high = curve["predicted"] - curve["band"], curve["predicted"] + curve["band"]
    axes.fill_between(curve["abscissa"], low, high, color=fitted.get_color(), alpha=0.3)
    axes.legend()
    return axes


def crack(result: SceneResult, axes: Axes = None) -> Axes:
    """The crack paths of a scene, m."""
    axes = _axes(axes)
    for number in numpy.unique(result.crack["crack"]):
        path = result.crack[result.crack["crack"] == number]
        axes.plot(path["x"], path["y"])
    axes.set_aspect("equal")
    axes.set_xlabel("x, m")
    axes.set_ylabel("y, m")
    return axes


def frame(particles: dict[str, numpy.ndarray], field: str = "damage", axes: Axes = None, **dots: Any) -> Axes:
    """The particles of a frame (fpz.read_frame()), coloured by a field. Keywords go to matplotlib's scatter()."""
    axes = _axes(axes)
    points = particles["points"]
    drawn = axes.scatter(points[:, 0], points[:, 1], c=particles[field], **{"s": 4, **dots})
    axes.figure.colorbar(drawn, ax=axes, label=field)
    axes.set_aspect("equal")
    return axes
