"""Puts a model into the canonical frame: z up, standing on z = 0, the central fold along x (Sec. 4.1).

The heading comes from NPCA over the normals, from the long edges, or from the model's own axes. The fold is
where the best vertical mirror plane meets the base; where the two planes of the heading mirror about equally
well, it runs along the longer side.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from popsim.errors import MeshError
from popsim.geometry.arrays import FloatArray, locked
from popsim.mesh.bounds import RobustBounds, robust_bounds
from popsim.mesh.formats import format_of
from popsim.mesh.heading import Heading, choose_heading
from popsim.mesh.model import Model
from popsim.mesh.sampling import Samples, sample_surface
from popsim.mesh.symmetry import MirrorPlane
from popsim.mesh.up_axis import UP_AXES, UpChoice, axis_vector, choose_up

Method = Literal["npca", "edges", "none"]
Fold = Literal["auto", "long", "short"]
METHODS: tuple[Method, ...] = ("npca", "edges", "none")
FOLDS: tuple[Fold, ...] = ("auto", "long", "short")

SAMPLES = 2500
"""Points that stand for the model here; mirror scores repeat to about 0.02."""
EQUAL_SYMMETRY = 0.08
"""Mirror planes whose scores differ by less are equally good, and the longer side decides."""
ASYMMETRIC = 0.5
"""Below this score the model has no mirror plane to speak of, and the longer side decides."""
SQUARE = 1.02
"""Sides whose ratio is below this are equally long."""
LEAN = 0.004
"""Moments (relative to the extents) below this are noise, and the front cannot be told by them."""


@dataclass(frozen=True, eq=False)
class Alignment:
    """A rigid motion from model coordinates to the canonical frame, and why it is this one.

    Attributes
    ----------
    matrix:
        Homogeneous, a proper rotation and a shift, no scale: shape (4, 4). In the canonical frame (file units)
        z is up, the model stands on z = 0, its mirror plane is y = 0 and its x range is centred on 0.
    axes:
        Which model direction became x, y and z: names like "-z", or "askew".
    up:
        The choice of the up direction.
    symmetry:
        The mirror plane in model coordinates, and its score.
    box:
        Robust bounding box in the canonical frame.
    confidence:
        0..1, that up is right.
    reasons:
        Sentences for the report.
    """

    matrix: FloatArray
    axes: tuple[str, str, str]
    up: UpChoice
    symmetry: MirrorPlane
    box: RobustBounds
    confidence: float
    reasons: tuple[str, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "matrix", locked(self.matrix, (4, 4), "alignment matrix"))


def align(
    model: Model,
    *,
    up: str = "auto",
    front: str | None = None,
    method: Method = "npca",
    fold: Fold = "auto",
    seed: int = 0,
) -> Alignment:
    """Find the canonical frame of a model.

    Parameters
    ----------
    model:
        As loaded.
    up:
        The model axis that points up, one of :data:`popsim.mesh.up_axis.UP_AXES`, or "auto".
    front:
        The model axis that points to +x, as nearly as the heading allows; None to choose by shape.
    method:
        "npca": normals; "edges": long edges; "none": the model's own axes.
    fold:
        "auto": in the best mirror plane; "long" or "short": along that horizontal side.
    seed:
        Of the sample points.

    Raises
    ------
    MeshError
        An option has an unknown value, or `front` is the up axis.
    """
    _check_options(up, front, method, fold)
    samples = sample_surface(model.surface, SAMPLES, seed=seed)
    custom = format_of(model.path).up
    choice = choose_up(model.surface, samples, custom, up)
    if front is not None and abs(axis_vector(front, "front") @ choice.direction) > 0.9:
        raise MeshError(f"front: '{front}' is the up axis ({choice.name}); choose a horizontal axis")
    heading = choose_heading(model.surface, samples, choice.direction, method)
    along, why_fold = _fold_side(heading, fold, front)
    x = heading.directions[along]
    plane = heading.planes[1 - along]
    if front is None:
        x, why_front = _front_by_shape(samples, x, choice.direction)
    else:
        x, why_front = x * (1 if x @ axis_vector(front, "front") > 0 else -1), f"{front} is the front, as told"
    rotation = _tidy(np.stack([x, np.cross(choice.direction, x), choice.direction]))
    matrix, box = _stand(model, samples, rotation, plane)
    reasons = (choice.reason, heading.reason, why_fold, why_front, *(str(part) for part in box.left_out))
    axes = (_axis_name(rotation[0]), _axis_name(rotation[1]), _axis_name(rotation[2]))
    return Alignment(matrix, axes, choice, plane, box, choice.confidence, reasons)


def _check_options(up: str, front: str | None, method: str, fold: str) -> None:
    for option, value, known in (
        ("up", up, (*UP_AXES, "auto")),
        ("front", front, (*UP_AXES, None)),
        ("method", method, METHODS),
        ("fold", fold, FOLDS),
    ):
        if value not in known:
            words = ", ".join(str(k) for k in known if k is not None)
            raise MeshError(f"{option}: '{value}' is unknown; expected one of {words}")


def _fold_side(heading: Heading, fold: Fold, front: str | None) -> tuple[int, str]:
    """Return along which of the two horizontal directions the fold runs, and why."""
    first, second = heading.extents
    longer = 0 if first >= second else 1
    scores = heading.planes[1].score, heading.planes[0].score  # of the plane that contains each direction
    if front is not None:
        along = int(np.abs(heading.directions @ axis_vector(front, "front")).argmax())
        return along, f"the fold runs to the front; mirror score {scores[along]:.2f}"
    if fold != "auto":
        along = longer if fold == "long" else 1 - longer
        return along, f"the fold runs along the {fold} side, as told; mirror score {scores[along]:.2f}"
    better = 0 if scores[0] >= scores[1] else 1
    unequal = max(scores) > ASYMMETRIC and abs(scores[0] - scores[1]) > EQUAL_SYMMETRY
    if unequal or max(first, second) < SQUARE * min(first, second):
        return better, f"the fold lies in the best mirror plane, score {scores[better]:.2f} of 1"
    return longer, f"the fold runs along the longer side; mirror score {scores[longer]:.2f} of 1"


def _front_by_shape(samples: Samples, x: FloatArray, up: FloatArray) -> tuple[FloatArray, str]:
    """Return x or -x, whichever points to the lower end, or else to the end with less area."""
    weight = samples.area / samples.area.sum()
    along, height = _centred(samples.points @ x), _centred(samples.points @ up)
    for moment, words in (
        (weight @ (along * (height - weight @ height)), "the lower end is the front"),
        (weight @ along, "the end with less surface is the front"),
    ):
        if abs(moment) > LEAN:
            return -x * np.sign(moment), words
    largest = x[np.abs(x).argmax()]
    return x * np.sign(largest), "both ends look alike; the front follows the model's axes"


def _centred(values: FloatArray) -> FloatArray:
    """Scale values to -0.5..0.5."""
    low, high = values.min(), values.max()
    return np.asarray((values - (low + high) / 2) / max(float(high - low), 1e-300))


def _stand(
    model: Model, samples: Samples, rotation: FloatArray, plane: MirrorPlane
) -> tuple[FloatArray, RobustBounds]:
    """Shift the turned model onto the base; return the whole motion and the box there."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    box = robust_bounds(model.surface.transformed(matrix), samples.moved(matrix))
    middle = plane.offset * np.sign(plane.normal @ rotation[1])
    shift = -np.array([box.bounds[:, 0].mean(), middle, box.bounds[0, 2]])
    matrix[:3, 3] = shift
    left_out = tuple(type(part)(part.bounds + shift, part.area_share, part.reason) for part in box.left_out)
    return matrix, RobustBounds(box.bounds + shift, left_out)


def _tidy(rotation: FloatArray) -> FloatArray:
    """Round what arithmetic left of exact zeros and ones."""
    rounded = np.round(rotation)
    return np.where(np.abs(rotation - rounded) < 1e-9, rounded + 0.0, rotation)


def _axis_name(direction: FloatArray) -> str:
    largest = int(np.abs(direction).argmax())
    if abs(direction[largest]) < np.cos(np.radians(1)):
        return "askew"
    return ("-" if direction[largest] < 0 else "") + "xyz"[largest]
