"""Directions in model coordinates, by name or by numbers."""

import math

import numpy as np

from popsim.errors import MeshError
from popsim.geometry.arrays import FloatArray

UP_AXES = ("x", "-x", "y", "-y", "z", "-z")
"""Names of the model axes."""

ASKEW = "askew"
"""What a direction is called that is none of them."""

ALONG = np.cos(np.radians(1))
"""A direction within a degree of an axis has its name."""


def direction_of(text: str, option: str) -> FloatArray:
    """Return the unit vector, shape (3,), of an axis name ("-x") or of three numbers ("0.2,0,1").

    Raises
    ------
    MeshError
        The text is neither; the message names the `option`.
    """
    if text in UP_AXES:
        return np.asarray(np.eye(3)["xyz".index(text[-1])] * (-1.0 if text.startswith("-") else 1.0))
    try:
        values = [float(word) for word in text.split(",")]
    except ValueError:
        values = []
    length = math.hypot(*values)
    if len(values) != 3 or not 0 < length < math.inf:
        raise MeshError(
            f"{option}: '{text}' is no direction; expected one of {', '.join(UP_AXES)}, or numbers as 0.2,0,1"
        )
    return np.array(values) / length


def axis_name(direction: FloatArray) -> str:
    """Return the name of the model axis that a unit vector follows, or "askew"."""
    largest = int(np.abs(direction).argmax())
    if abs(direction[largest]) < ALONG:
        return ASKEW
    return ("-" if direction[largest] < 0 else "") + "xyz"[largest]
