"""Bare test shapes without texture. z up."""

import numpy as np

from modelling.mesh import FloatArray
from modelling.shapes import loft, prism, rounds


def t_shape() -> FloatArray:
    """Return a T of height 3 and width 3, one unit thick and deep."""
    outline = [(-0.5, 0), (0.5, 0), (0.5, 2), (1.5, 2), (1.5, 3), (-1.5, 3), (-1.5, 2), (-0.5, 2)]
    return prism(outline, "y", -0.5, 0.5)


def skewed_cube() -> FloatArray:
    """Return a unit cube whose top is shifted by half a unit along x."""
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=np.float64)
    return loft([square, square + np.array([0.5, 0, 1])])


def half_sphere() -> FloatArray:
    """Return the upper half of the unit sphere, closed below."""
    angles = np.linspace(0, np.pi / 2, 13)
    return rounds(np.sin(angles).tolist(), np.cos(angles).round(12).tolist(), "z", 48)
