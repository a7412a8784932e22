"""Which way is up: the custom of the file format weighed against the shape.

Six directions compete. Each gets the logarithm of its prior weight (:mod:`popsim.mesh.formats`) plus the
evidence of the shape; the winner's share of the summed exponentials is the confidence. The weights of the
evidence are round numbers near the fit to 26 models whose up axis is known; leaving out any one of them, the
fit to the others finds its up axis.

A model whose faces and mirror planes follow other axes much better than those of its file stands askew; the
directions of these axes compete instead, and the custom of the format says little about them.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.extent import extent
from popsim.geometry.surface import Surface
from popsim.mesh.axes import ASKEW, UP_AXES, axis_name, direction_of
from popsim.mesh.directions import axes_about, axis_share, inertia_axes, principal_axes
from popsim.mesh.formats import OTHER_AXIS
from popsim.mesh.sampling import Samples
from popsim.mesh.symmetry import MirrorSearch

DOWNWARD = 0.005
"""Prior weight of negative axes: nearly nobody stores a model upside down."""
ORIGIN_TOLERANCE, CENTRE_TOLERANCE = 0.02, 0.1
"""How far off the origin, relative to the extent, a model still counts as standing on it and centred on it."""
USUAL = 0.1
"""A custom with more than this weight may be called usual."""
SLICE = 0.03
"""Share of the height that counts as bottom and as top."""
ASKEW_GAIN = 0.2
"""How much better than the model's own axes a frame must suit it (:func:`_suits`) for the model to be askew."""
ANY_TILT = 0.1
"""Prior weight of every direction of an askew model: it may lie anyhow."""
SMALL_TILT = 8
"""Power of the cosine with which the custom of the format fades as the tilt grows: half at 24 degrees."""


class Evidence(NamedTuple):
    """What speaks for one direction, each about -1..1; the weights are in :data:`WEIGHTS`."""

    stands_on_origin: float
    symmetry: float
    support: float
    support_over_top: float
    low_centre: float


WEIGHTS = Evidence(stands_on_origin=3.0, symmetry=1.5, support=1.5, support_over_top=1.0, low_centre=1.0)
_WORDS = (  # one per field of Evidence
    "the model stands on the origin, centred",
    "mirror planes are vertical",
    "the base is wide",
    "the base is wider than the top",
    "most of the surface is low",
)


@dataclass(frozen=True, eq=False)
class UpChoice:
    """The direction that is taken to be up.

    Attributes
    ----------
    direction:
        Unit vector in model coordinates, shape (3,).
    name:
        Of the axis that it follows, or "askew" if it is none; see :mod:`popsim.mesh.axes`.
    confidence:
        0..1; 1 where the user said so.
    reason:
        One sentence.
    """

    direction: FloatArray
    name: str
    confidence: float
    reason: str

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", locked(self.direction, (3,), "up direction"))


def stated_up(text: str) -> UpChoice:
    """Return the direction that the user states (:func:`popsim.mesh.axes.direction_of`).

    Raises
    ------
    MeshError
        It is none.
    """
    direction = direction_of(text, "up")
    return UpChoice(direction, axis_name(direction), 1.0, f"{text} is up because the up option says so")


def choose_up(surface: Surface, samples: Samples, custom: dict[str, float]) -> UpChoice:
    """Find the up direction by the shape.

    Parameters
    ----------
    surface, samples:
        The model, and points on it in the same frame.
    custom:
        Prior weights of the positive axes, by the format.
    """
    search = MirrorSearch(samples)
    prior = [_axis_prior(name, custom) for name in UP_AXES]
    choice, evidence, confidence = _best(surface, samples, search, np.eye(3), prior, on_axes=True)
    own = max(_suits(samples, search, axes) for axes in (np.eye(3), axes_about(samples, choice // 2)))
    for frame in (principal_axes(samples), inertia_axes(samples)):
        if _suits(samples, search, frame) > own + ASKEW_GAIN:
            return _askew_choice(surface, samples, search, frame, custom)
    name = UP_AXES[choice]
    usual = " and ".join(axis for axis, weight in custom.items() if weight > USUAL)
    agrees = "as is usual" if custom.get(name, 0.0) > USUAL else f"although {usual} is usual"
    reason = f"{name} is up, {agrees} for the format: {_why(evidence)}"
    return UpChoice(direction_of(name, "up"), name, confidence, reason)


def _askew_choice(
    surface: Surface, samples: Samples, search: MirrorSearch, axes: FloatArray, custom: dict[str, float]
) -> UpChoice:
    """Choose among the six directions of the axes that a model follows, askew in its file."""
    directions = _signed(axes)
    prior = [_tilted_prior(direction, custom) for direction in directions]
    choice, evidence, confidence = _best(surface, samples, search, axes, prior, on_axes=False)
    reason = f"the model stands askew in its file; by its principal axes: {_why(evidence)}"
    return UpChoice(directions[choice], ASKEW, confidence, reason)


def _axis_prior(name: str, custom: dict[str, float]) -> float:
    return DOWNWARD if name.startswith("-") else custom.get(name, OTHER_AXIS)


def _tilted_prior(direction: FloatArray, custom: dict[str, float]) -> float:
    """Prior of a direction between the axes: a small tilt of a custom, or any."""
    along = {axis: max(0.0, float(direction["xyz".index(axis)])) for axis in custom}
    return ANY_TILT + sum(weight * along[axis] ** SMALL_TILT for axis, weight in custom.items())


def _suits(samples: Samples, search: MirrorSearch, axes: FloatArray) -> float:
    """How well faces and mirror planes follow axes (3, 3): share of the area, and the best mirror score; 0..2.

    Planes through the middle and the centroid are tried: a perfect one holds both.
    """
    points = samples.points @ axes.T
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    centroid = samples.area @ points / samples.area.sum()
    scores = [search.score(axis, float(at[k])) for k, axis in enumerate(axes) for at in (middle, centroid)]
    return axis_share(samples, axes) + max(scores)


def _signed(axes: FloatArray) -> FloatArray:
    """Return the six directions of three axes, in the order of :data:`UP_AXES`, shape (6, 3)."""
    return np.stack([axes, -axes], axis=1).reshape(6, 3)


def _best(
    surface: Surface,
    samples: Samples,
    search: MirrorSearch,
    axes: FloatArray,
    prior: list[float],
    *,
    on_axes: bool,
) -> tuple[int, Evidence, float]:
    evidence = _evidence(surface, samples, search, axes, on_axes=on_axes)
    score = np.log(prior) + np.array(evidence) @ np.array(WEIGHTS)
    choice = int(score.argmax())
    return choice, evidence[choice], float(1 / np.exp(score - score[choice]).sum())


def _why(evidence: Evidence) -> str:
    parts = zip(_WORDS, WEIGHTS, evidence, strict=True)
    words = [word for word, weight, value in parts if weight * value > 0.5]
    return ", ".join(words) if words else "the shape says little"


def _evidence(
    surface: Surface, samples: Samples, search: MirrorSearch, axes: FloatArray, *, on_axes: bool
) -> list[Evidence]:
    """Evidence for the six directions of `axes`, in the order of :func:`_signed`."""
    low, high = extent(surface.triangles.reshape(-1, 3), axes)
    mirror = np.array([search.best_plane(axes[k], (low[k], high[k])).score for k in range(3)])
    points = (samples.points @ axes.T - low) / np.maximum(high - low, 1e-300)
    centre = (samples.area @ points) / samples.area.sum()
    result = []
    for k in range(3):
        others = [j for j in range(3) if j != k]
        ends = [_hull_share(points[mask][:, others]) for mask in (points[:, k] < SLICE, points[:, k] > 1 - SLICE)]
        for side, base in enumerate((low[k], -high[k])):
            stands = _stands(base, low, high, k) if on_axes else 0.0
            symmetry = float(mirror[others].sum() - 2 * mirror[k])
            low_centre = float((0.5 - centre[k]) * (1 - 2 * side))
            result.append(Evidence(stands, symmetry, ends[side], ends[side] - ends[1 - side], low_centre))
    return result


def _stands(base: float, low: FloatArray, high: FloatArray, axis: int) -> float:
    """How well the model stands on the plane 0 of an axis, centred in the other two, 0..1."""
    extent = np.maximum(high - low, 1e-300)
    shift = np.delete(np.abs(low + high) / 2 / extent, axis).max()
    return float(np.exp(-((base / extent[axis] / ORIGIN_TOLERANCE) ** 2) - (shift / CENTRE_TOLERANCE) ** 2))


def _hull_share(points: FloatArray) -> float:
    """Area of the convex hull of points (n, 2) in the unit square."""
    from shapely import MultiPoint

    return float(MultiPoint(points).convex_hull.area) if len(points) else 0.0
