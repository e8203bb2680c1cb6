"""What the tests of the Python module share."""

import os
import pathlib
import unittest
import warnings

import numpy

import fpz

DATA = pathlib.Path(os.environ["FPZ_DATA_DIR"])
PROGRAMS = pathlib.Path(os.environ["FPZ_PROGRAMS"])

ROCK = dict(
    young_modulus=4e8,
    poisson_ratio=0.25,
    density=1540.0,
    tensile_strength=6e5,
    cohesion=1e6,
    friction_angle_deg=33.0,
    dilation_angle_deg=4.0,
    delta0=1.8e-5,
    normal_stiffness=1e13,
    shear_stiffness=1e13,
)


def rock(**changes):
    """A soft rock; no warnings are due."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return fpz.Material(**{**ROCK, "rve_length": 0.004, **changes})


def walks(material, count, steps, seed=1):
    """Strain increments, shape (steps, count, n), of walks on which most points crack, reload and unload."""
    random = numpy.random.default_rng(seed)
    n = 3 if material.dim == 2 else 6
    drift = random.normal(size=(1, count, n)) * 4e-4
    return drift + random.normal(size=(steps, count, n)) * 4e-4


def needs(part):
    """Skips where the build has no such part."""
    return unittest.skipUnless(hasattr(fpz._core, part), f"this build has no {part}")


def program(name):
    """The program's path, or skips."""
    path = PROGRAMS / name
    if not path.exists():
        raise unittest.SkipTest(f"this build has no {name}")
    return str(path)
