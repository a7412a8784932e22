"""Which way is up: the custom of the file format weighed against the shape.

Six directions compete. Each gets the logarithm of its prior weight (:mod:`popsim.mesh.formats`) plus the
evidence of the shape; the winner's share of the summed exponentials is the confidence. The weights of the
evidence are round numbers near the fit to 26 models whose up axis is known; leaving out any one of them, the
fit to the others finds its up axis.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from popsim.errors import MeshError
from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.surface import Surface
from popsim.mesh.directions import axes_about, axis_share, principal_axes
from popsim.mesh.formats import OTHER_AXIS
from popsim.mesh.sampling import Samples
from popsim.mesh.symmetry import MirrorSearch

UP_AXES = ("x", "-x", "y", "-y", "z", "-z")
"""Names of the model axes, the values of the `up` and `front` options."""

DOWNWARD = 0.005
"""Prior weight of negative axes: nearly nobody stores a model upside down."""
ORIGIN_TOLERANCE, CENTRE_TOLERANCE = 0.02, 0.1
"""How far off the origin, relative to the extent, a model still counts as standing on it and centred on it."""
USUAL = 0.1
"""A custom with more than this weight may be called usual."""
SLICE = 0.03
"""Share of the height that counts as bottom and as top."""
ASKEW_GAIN = 0.15
"""Area share that the NPCA frame must cover beyond the best frame about the up axis for a model to be askew."""


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
        One of :data:`UP_AXES`, or "askew" if it is none of them.
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


def axis_vector(name: str, option: str) -> FloatArray:
    """Return the unit vector of an axis name; MeshError naming the `option` for another word."""
    if name not in UP_AXES:
        raise MeshError(f"{option}: '{name}' is not an axis; expected one of {', '.join(UP_AXES)}")
    return np.asarray(np.eye(3)["xyz".index(name[-1])] * (-1.0 if name.startswith("-") else 1.0))


def choose_up(surface: Surface, samples: Samples, custom: dict[str, float], up: str = "auto") -> UpChoice:
    """Find the up direction.

    Parameters
    ----------
    surface, samples:
        The model, and points on it in the same frame.
    custom:
        Prior weights of the positive axes, by the format.
    up:
        An axis name, or "auto".

    Raises
    ------
    MeshError
        `up` is neither.
    """
    if up != "auto":
        return UpChoice(axis_vector(up, "up"), up, 1.0, f"{up} is up because the up option says so")
    prior = [_axis_prior(name, custom) for name in UP_AXES]
    choice, evidence, confidence = _best(surface, samples, np.eye(3), prior, on_axes=True)
    axes = principal_axes(samples)
    if _is_askew(samples, axes, choice // 2):
        return _askew_choice(surface, samples, axes, custom)
    name = UP_AXES[choice]
    usual = " and ".join(axis for axis, weight in custom.items() if weight > USUAL)
    agrees = "as is usual" if custom.get(name, 0.0) > USUAL else f"although {usual} is usual"
    reason = f"{name} is up, {agrees} for the format: {_why(evidence)}"
    return UpChoice(axis_vector(name, "up"), name, confidence, reason)


def _askew_choice(surface: Surface, samples: Samples, axes: FloatArray, custom: dict[str, float]) -> UpChoice:
    """Choose among the principal axes of a model that stands askew in its file."""
    directions = _signed(axes)
    prior = [_tilted_prior(direction, custom) for direction in directions]
    choice, evidence, confidence = _best(surface, samples, axes, prior, on_axes=False)
    reason = f"the model stands askew in its file; by its principal axes: {_why(evidence)}"
    return UpChoice(directions[choice], "askew", confidence, reason)


def _axis_prior(name: str, custom: dict[str, float]) -> float:
    return DOWNWARD if name.startswith("-") else custom.get(name, OTHER_AXIS)


def _tilted_prior(direction: FloatArray, custom: dict[str, float]) -> float:
    """Prior of a direction between the axes: tilts are mostly small."""
    leaning = (weight * max(0.0, float(direction["xyz".index(axis)])) ** 4 for axis, weight in custom.items())
    return max(DOWNWARD, *leaning)


def _signed(axes: FloatArray) -> FloatArray:
    """Return the six directions of three axes, in the order of :data:`UP_AXES`, shape (6, 3)."""
    return np.stack([axes, -axes], axis=1).reshape(6, 3)


def _best(
    surface: Surface, samples: Samples, axes: FloatArray, prior: list[float], *, on_axes: bool
) -> tuple[int, Evidence, float]:
    evidence = _evidence(surface, samples, axes, on_axes=on_axes)
    score = np.log(prior) + np.array(evidence) @ np.array(WEIGHTS)
    choice = int(score.argmax())
    return choice, evidence[choice], float(1 / np.exp(score - score[choice]).sum())


def _why(evidence: Evidence) -> str:
    parts = zip(_WORDS, WEIGHTS, evidence, strict=True)
    words = [word for word, weight, value in parts if weight * value > 0.5]
    return ", ".join(words) if words else "the shape says little"


def _evidence(surface: Surface, samples: Samples, axes: FloatArray, *, on_axes: bool) -> list[Evidence]:
    """Evidence for the six directions of `axes`, in the order of :func:`_signed`."""
    corners = surface.triangles.reshape(-1, 3) @ axes.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    search = MirrorSearch(samples)
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


def _is_askew(samples: Samples, axes: FloatArray, up: int) -> bool:
    """Whether the faces line up with `axes` much better than with any frame about the coordinate axis `up`."""
    return axis_share(samples, axes) > axis_share(samples, axes_about(samples, up)) + ASKEW_GAIN
