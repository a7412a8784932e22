"""What of a model no paper shows."""

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.cluster import linked
from popsim.geometry.surface import Surface
from popsim.mesh.bounds import box_of
from popsim.mesh.sampling import Samples, sample_surface
from popsim.rendering.ray_scene import RayScene

POINTS = 4000
"""Points that stand for the model, and as many for the paper."""
AWAY = 0.06
"""Share of the model's longest side beyond which a point is not shown by the paper next to it."""
WORTH_TELLING = 0.01
"""Share of the area that is seen which a part needs to be listed."""
MOST = 6
"""Parts that are listed; the others are counted."""
LINK = 2.0
"""Points within this many spacings belong to one part."""


def leftovers(scene: RayScene, paper: Surface, longest: float) -> tuple[str, ...]:
    """List the parts of a model that can be seen and lie away from all paper, the largest first.

    Parameters
    ----------
    scene:
        The model in the card frame, mm.
    paper:
        The open pop-up without its pages, in the same frame.
    longest:
        Longest side of the model, mm.
    """
    from scipy.spatial import cKDTree

    samples = sample_surface(scene.surface, POINTS, seed=0)
    seen = _seen(scene, samples)
    shown = cKDTree(sample_surface(paper, POINTS, seed=0).points)
    away = seen & (shown.query(samples.points)[0] > AWAY * longest)
    if not away.any():
        return ()
    points, share = samples.points[away], samples.area[away] / samples.area[seen].sum()
    part = linked(points, LINK * samples.spacing)
    sizes = np.bincount(part, weights=share)
    large = [k for k in np.argsort(-sizes, kind="stable") if sizes[k] > WORTH_TELLING]
    told = [_words(box_of(points[part == k]), float(sizes[k])) for k in large[:MOST]]
    if len(large) > MOST:
        rest = float(sizes[large[MOST:]].sum())
        told.append(f"not shown: {len(large) - MOST} smaller parts, together {rest:.1%} of the surface")
    return tuple(told)


def _seen(scene: RayScene, samples: Samples) -> BoolArray:
    """Which samples are seen from the front, the back, a side, above, or from over a corner; shape (n,)."""
    ways = np.array([(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (0, 1) if (i, j, k) != (0, 0, 0)])
    start = 2 * scene.tolerance
    seen = np.zeros(len(samples.points), dtype=bool)
    for way in ways / np.linalg.norm(ways, axis=1)[:, None]:
        hidden = np.flatnonzero(~seen)
        met = scene.hit(samples.points[hidden], way[None], near=start, through_holes=False).face >= 0
        seen[hidden[~met]] = True
    return seen


def _words(box: FloatArray, share: float) -> str:
    size = " x ".join(f"{side:.0f}" for side in box[1] - box[0])
    at = ", ".join(f"{middle:.0f}" for middle in box.mean(axis=0))
    return f"not shown: a part of {size} mm at ({at}), {share:.1%} of the surface"
