"""What of a model hangs over the ground, and whether paper holds it up (the T-shape of Fig. 17)."""

from collections.abc import Sequence

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Mechanism
from popsim.rendering.ray_scene import RayScene

CELLS = 60
"""Rays along the longer side of the footprint."""
HIGH = 0.25
"""Share of the model's height from which on its underside hangs."""
WIDE = 0.1
"""Share of the footprint that must hang to be told."""


def overhang(scene: RayScene, bounds: FloatArray, mechanisms: Sequence[Mechanism]) -> tuple[str, ...]:
    """Tell how much of a model overhangs, and how much of that stands on paper that the model does not have.

    Parameters
    ----------
    scene:
        The model in the card frame, mm.
    bounds:
        What counts of it, rows low and high, shape (2, 3).
    mechanisms:
        The pop-up.
    """
    low, high = bounds
    step = float((high - low)[:2].max()) / CELLS
    x, y = (np.arange(low[k] + step / 2, high[k], step) for k in (0, 1))
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    origins = np.column_stack([grid, np.full(len(grid), low[2] - step)])
    under = scene.hit(origins, np.array([[0.0, 0.0, 1.0]])).distance - step
    hangs = np.isfinite(under) & (under > HIGH * (high[2] - low[2]))
    footprint = int(np.isfinite(under).sum())
    if hangs.sum() <= WIDE * footprint:
        return ()
    boxes = [mechanism.face_box() for mechanism in mechanisms if mechanism.pair.owner is None]
    held = np.zeros(len(grid), dtype=bool)
    for box in boxes:
        held |= ((grid > box[0, :2]) & (grid < box[1, :2])).all(axis=1)
    share, lift = hangs.sum() / footprint, float(np.median(under[hangs]))
    whole = f"{share:.0%} of the model's footprint hangs about {lift:.0f} mm over the ground"
    supported = (hangs & held).sum() / hangs.sum()
    if supported > WIDE:
        return (
            f"{whole}: for {supported:.0%} of that, paper beneath it is a support that the model does not have",
        )
    return (f"{whole}: it is shown where patches can follow it, and stands on nothing",)
