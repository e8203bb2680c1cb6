"""Mixed-mode fracture of rock with an embedded fracture process zone.

    import fpz
    rock = fpz.Material("johnstone.json", rve_length=0.004)
    point = fpz.Point(rock)
    point.update([1e-5, 0.0, 0.0])
    print(point.stress, point.damage)

SI units (angles in degrees), tension positive, shear strains are tensor components. Components of tensors: xx, yy, xy
in plane strain and plane stress; xx, yy, zz, xy, xz, yz in 3-D. Guide: docs/interface-python.md.
"""

from . import plot
from ._core import (
    BatchReport,
    Material,
    Point,
    UpdateReport,
    __version__,
    critical_plane,
    failure_values,
    state_dtype,
    update_batch,
)
from ._errors import FpzError, FpzWarning, InputError, OutputError, RunError, UpdateError
from ._runs import (
    CalibrationResult,
    PathResult,
    SceneResult,
    calibrate,
    read_frame,
    run_path,
    run_paths,
    run_scene,
)

__all__ = [
    "BatchReport",
    "CalibrationResult",
    "FpzError",
    "FpzWarning",
    "InputError",
    "Material",
    "OutputError",
    "PathResult",
    "Point",
    "RunError",
    "SceneResult",
    "UpdateError",
    "UpdateReport",
    "__version__",
    "calibrate",
    "critical_plane",
    "failure_values",
    "plot",
    "read_frame",
    "run_path",
    "run_paths",
    "run_scene",
    "state_dtype",
    "update_batch",
]
