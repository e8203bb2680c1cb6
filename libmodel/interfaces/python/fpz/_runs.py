"""Loading paths, fits and scenes, as the programs fpz-driver, fpz-calibrate and fpz-sph run them."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Union

import numpy

from . import _core
from ._errors import FpzError, RunError
from ._json import text_of

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Progress = Callable[[dict[str, Any]], Any]


@dataclass(frozen=True)
class PathResult:
    """What became of a loading path.

    history: records with the columns of history.csv (docs/driver.md), SI: time, eps_xx, ..., sig_xx, ..., D, ...
    summary: the content of summary.json. status: "ok", or why the history ends early, which `message` explains.
    """

    name: str
    status: str
    message: str
    history: numpy.ndarray = field(repr=False)
    summary: dict[str, Any] = field(repr=False)
    warnings: list[str] = field(repr=False)
    notes: list[str] = field(repr=False)

    @property
    def ok(self) -> bool:
        return self.status == "ok"


@dataclass(frozen=True)
class CalibrationResult:
    """A fit to laboratory data.

    material: the content of material.json, a dictionary that fpz.Material() takes. report: that of report.json
    (docs/calibration.md), with errors, intervals and correlations. curves: for each data set records with abscissa,
    measured, deviation, predicted, band (half width) and residual, SI.
    """

    name: str
    status: str
    message: str
    material: dict[str, Any] = field(repr=False)
    report: dict[str, Any] = field(repr=False)
    curves: dict[str, numpy.ndarray] = field(repr=False)
    warnings: list[str] = field(repr=False)
    notes: list[str] = field(repr=False)

    @property
    def ok(self) -> bool:
        return self.status == "ok"


@dataclass(frozen=True)
class SceneResult:
    """A specimen of the particle method.

    history: records with the columns of history.csv (docs/scenes.md), SI. summary: the content of summary.json.
    crack: records crack, point, x, y (m), damage. frames: (time, file) of each, for read_frame(); empty without `out`.
    """

    name: str
    status: str
    message: str
    history: numpy.ndarray = field(repr=False)
    summary: dict[str, Any] = field(repr=False)
    crack: numpy.ndarray = field(repr=False)
    frames: list[tuple[float, str]] = field(repr=False)
    report: str = field(repr=False)
    warnings: list[str] = field(repr=False)
    notes: list[str] = field(repr=False)

    @property
    def ok(self) -> bool:
        return self.status == "finished"


def _part(name: str, option: str) -> Callable[..., Any]:
    """The compiled function, which a build without that part does not have."""
    function = getattr(_core, name, None)
    if function is None:
        raise FpzError(f"this build of fpz was made without this part: configure it with -D{option}=ON")
    return function


def _text_and_file(source: Source, folder: str | os.PathLike[str], kind: str) -> tuple[str | None, str]:
    if isinstance(source, Mapping):
        return text_of(source), os.path.join(os.fspath(folder), kind) if os.fspath(folder) else kind
    return None, os.fspath(source)


def run_paths(
    source: Source, *, folder: str | os.PathLike[str] = "", progress: Progress | None = None, check: bool = True
) -> dict[str, PathResult]:
    """Runs all tests of a path file, or of a dictionary with its content; results under the tests' names.

    folder: what names of material files in a dictionary are relative to. progress: called now and then with a
    dictionary: name, fraction (0 to 1), damage; an exception that it raises ends the run, as Ctrl-C does. check: raise
    RunError when a test does not come through.
    """
    text, file = _text_and_file(source, folder, "path")
    results = {}
    for made in _part("_run_tests", "FPZ_BUILD_DRIVER")(text, file, progress):
        made["summary"] = json.loads(made["summary"])
        results[made["name"]] = result = PathResult(**made)
        if check and not result.ok:
            raise RunError(f"{result.name}: {result.status}: {result.message}", result)
    return results


def run_path(
    source: Source, *, folder: str | os.PathLike[str] = "", progress: Progress | None = None, check: bool = True
) -> PathResult:
    """The same for a path file with one test. Raises ValueError when there are several."""
    results = run_paths(source, folder=folder, progress=progress, check=check)
    if len(results) != 1:
        raise ValueError(f"{len(results)} tests: use run_paths()")
    return next(iter(results.values()))


def calibrate(
    source: Source,
    *,
    folder: str | os.PathLike[str] = "",
    out: str | os.PathLike[str] | None = None,
    force: bool = False,
    pictures: bool = False,
    starts: int = 0,
    progress: Progress | None = None,
    check: bool = True,
) -> CalibrationResult:
    """Fits a material to laboratory data: a specification file, or a dictionary with its content.

    folder: what names of files in a dictionary are relative to. out: folder for the report, as fpz-calibrate writes it
    (force: replace files that exist; pictures: draw them, with gnuplot). starts: in place of the specification's.
    progress: called between the parts of the fit with a dictionary: name, stage, fraction (of it), cost; then also
    Ctrl-C is seen. check: raise RunError when the fit is not usable.
    """
    text, file = _text_and_file(source, folder, "specification")
    run = _part("_calibrate", "FPZ_BUILD_CALIBRATION")
    made = run(text, file, progress, starts, None if out is None else os.fspath(out), force, pictures)
    made["material"] = json.loads(made["material"])
    made["report"] = json.loads(made["report"])
    result = CalibrationResult(**made)
    if check and not result.ok:
        raise RunError(f"{result.name}: the fit is not usable: {result.status}: {result.message}", result)
    return result


def _rows_of_csv(file: str) -> numpy.ndarray:
    return numpy.atleast_1d(numpy.genfromtxt(file, delimiter=",", names=True))


def run_scene(
    source: Source,
    *,
    folder: str | os.PathLike[str] = "",
    overrides: Mapping[str, Any] | Sequence[str] = (),
    out: str | os.PathLike[str] | None = None,
    force: bool = False,
    resume: bool = False,
    threads: int = 0,
    most_steps: int = 0,
    progress: Progress | None = None,
    check: bool = True,
) -> SceneResult:
    """Runs a scene of the particle method: a scene file, or a dictionary with its content.

    folder: what names of files in a dictionary are relative to. overrides: {"method.courant": 0.3} or
    ["method.courant=0.3"]. out: folder for the files of the run; without it a temporary one, and no frames remain.
    force: replace an earlier run there; resume: go on from its checkpoint. threads: 0 as the scene says. most_steps:
    stop after so many steps, with a checkpoint. progress: called now and then with a dictionary: fraction (0 to 1),
    seconds, time (s), load (N), damaged, steps_per_second; an exception that it raises ends the run with a checkpoint,
    as Ctrl-C does. check: raise RunError when the run fails.
    """
    text, file = _text_and_file(source, folder, "scene")
    if isinstance(overrides, Mapping):
        overrides = [f"{key}={value if isinstance(value, str) else text_of(value)}" for key, value in overrides.items()]
    run = _part("_run_scene", "FPZ_BUILD_SPH")
    with tempfile.TemporaryDirectory(prefix="fpz-") as temporary:
        to = temporary if out is None else os.fspath(out)
        made = run(text, file, list(overrides), to, progress, force, resume, threads, most_steps)
        over = made["status"] != "interrupted"
        crack, summary = made.pop("crack_file"), made.pop("summary_file")
        made["crack"] = _rows_of_csv(crack) if over else numpy.empty(0)
        made["summary"] = json.load(open(summary, encoding="utf-8")) if over else {}
        if out is None:
            made["frames"] = []
    result = SceneResult(**made)
    if check and result.status == "failed":
        raise RunError(f"{result.name}: {result.message}", result)
    return result


def read_frame(file: str | os.PathLike[str]) -> dict[str, numpy.ndarray]:
    """The particles of a frame (.vtu): "points", shape (count, 3), m, and every field, such as damage or stress."""
    return _part("_read_frame", "FPZ_BUILD_SPH")(os.fspath(file))
