"""The size of the card: both pages contain the open pop-up and the closed one."""

from collections.abc import Sequence

import numpy as np

from popsim.design import Card
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import OPEN
from popsim.geometry.rigid import transform
from popsim.mechanisms import Mechanism

MARGIN = 6.0
"""mm of page that stays free around everything, open and closed."""

STEP = 1.0
"""mm; pages are rounded up to this."""

ANGLES = np.linspace(OPEN, 0.0, 31)


def reached(mechanisms: Sequence[Mechanism], outlines: dict[str, FloatArray] | None = None) -> FloatArray:
    """How far mechanisms reach while closing: x from, x to, and from the fold (open or closed), mm, shape (3,).

    `outlines` replace the plain faces, by patch id.
    """
    outlines = outlines or {}
    low, high, away = np.inf, -np.inf, 0.0
    for mechanism in mechanisms:
        poses = mechanism.poses(ANGLES)
        for plate in mechanism.plates():
            corners = outlines.get(mechanism.patch_id(plate.role), plate.outline)
            swept = transform(poses[plate.role], corners)
            low, high = min(low, float(swept[..., 0].min())), max(high, float(swept[..., 0].max()))
            away = max(away, float(np.abs(swept[0, :, 1]).max()), float(swept[-1, :, 2].max()))
    return np.array([low, high, away])


def fitting_card(mechanisms: Sequence[Mechanism], outlines: dict[str, FloatArray] | None = None) -> Card:
    """The smallest card, in whole millimetres, that holds everything with a margin; symmetric about x = 0."""
    low, high, away = reached(mechanisms, outlines)
    half = float(np.ceil((max(-low, high) + MARGIN) / STEP) * STEP)
    depth = float(np.ceil((away + MARGIN) / STEP) * STEP)
    return Card(x=(-half, half), depth=depth)
