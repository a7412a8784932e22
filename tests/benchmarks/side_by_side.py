"""How much one surface looks like another from nine sides: the mean overlap of what is seen."""

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Surface
from popsim.rendering.ray_scene import RayScene

PIXELS = 120
"""Along the diagonal of the model."""

DEEP = 0.04
"""Share of the diagonal by which depths may differ and still count as the same."""


def eyes() -> FloatArray:
    """Directions to the eye: front, back, sides, top, and four 30 degrees over the corners; shape (9, 3)."""
    level = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
    flat = np.cos(np.radians(30)) / np.sqrt(2)
    return np.array(level + [(i * flat, j * flat, 0.5) for i in (1, -1) for j in (1, -1)], dtype=np.float64)


def likeness(model: RayScene, bounds: FloatArray, other: Surface) -> tuple[float, float]:
    """Return the shares of what either shows that both show, and that both show at the same depth; 0..1."""
    shown = RayScene(other)
    centre, diagonal = bounds.mean(axis=0), float(np.linalg.norm(bounds[1] - bounds[0]))
    steps = ((np.arange(PIXELS) + 0.5) / PIXELS - 0.5) * diagonal
    across, up = (grid.reshape(-1, 1) for grid in np.meshgrid(steps, steps))
    silhouettes, reliefs = [], []
    for eye in eyes():
        upright = np.array([0.0, 0.0, 1.0]) if abs(eye[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
        right = np.cross(upright, eye) / np.linalg.norm(np.cross(upright, eye))
        origins = centre + 2 * diagonal * eye + across * right + up * np.cross(eye, right)
        one, two = (scene.hit(origins, -eye[None], through_holes=False).distance for scene in (model, shown))
        both = np.isfinite(one) & np.isfinite(two)
        either = (np.isfinite(one) | np.isfinite(two)).sum()
        silhouettes.append(both.sum() / either)
        reliefs.append((np.abs(one[both] - two[both]) <= DEEP * diagonal).sum() / either)
    return float(np.mean(silhouettes)), float(np.mean(reliefs))
