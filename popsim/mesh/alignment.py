"""Puts a model into the canonical frame: z up, standing on z = 0, the central fold along x (Sec. 4.1).

The heading comes from NPCA over the normals, from the long edges, from the model's own axes, or from the user.
The fold is where the best vertical mirror plane meets the base; where the two planes of the heading mirror about
equally well, it runs along the longer side. Where the other one mirrors well too, or the longer side speaks for
it, :func:`alignments` gives both, for fitting to choose.

How a model lies in its file does not matter to what is found by its shape. It matters to the up axis and to the
front where the format has a custom: the same shape turned in its file can be another way round
(:mod:`popsim.mesh.front`), unless the user states both.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from popsim.errors import MeshError
from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.surface import Surface
from popsim.mesh.axes import axis_name, direction_of
from popsim.mesh.bounds import RobustBounds
from popsim.mesh.directions import Peak, edge_headings, horizontal_basis, normal_headings
from popsim.mesh.formats import format_of
from popsim.mesh.front import FrontChoice, choose_front, stated_front
from popsim.mesh.heading import Heading, choose_heading
from popsim.mesh.level import SQUARE, Level, levelled
from popsim.mesh.model import Model
from popsim.mesh.on_edge import set_on_edge
from popsim.mesh.sampling import sample_surface
from popsim.mesh.symmetry import MirrorPlane
from popsim.mesh.up_axis import UpChoice, choose_up, stated_up

Side = Literal["long", "short"]
Fold = Literal["auto", "long", "short"]
METHODS = ("npca", "edges", "none")
FOLDS: tuple[Fold, ...] = ("auto", "long", "short")

SAMPLES = 2500
"""Points that stand for the model here; mirror scores repeat to about 0.02."""
EQUAL_SYMMETRY = 0.08
"""Mirror planes whose scores differ by less are equally good, and the longer side decides."""
ASYMMETRIC = 0.5
"""Below this score the model has no mirror plane to speak of, and the longer side decides."""
WELL = 0.8
"""From this score on the second mirror plane is as good a guess."""
LONGER = 1.1
"""So is a side that is longer by this factor."""
VERTICAL = 0.9
"""A front whose part along the up axis is above this points up or down, not forward."""


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
    fold:
        The horizontal side along which the fold runs.
    up:
        The choice of the up direction, and how sure it is.
    heading_confidence:
        0..1, that the model is turned rightly about the up axis, up to a half turn; 1 where the user said so.
    front_confidence:
        0..1, that x points to its front and not to its back; 1 where the user said so.
    symmetry:
        The mirror plane in model coordinates, and its score.
    box:
        Robust bounding box in the canonical frame.
    reasons:
        Sentences for the report.
    """

    matrix: FloatArray
    axes: tuple[str, str, str]
    fold: Side
    up: UpChoice
    heading_confidence: float
    front_confidence: float
    symmetry: MirrorPlane
    box: RobustBounds
    reasons: tuple[str, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "matrix", locked(self.matrix, (4, 4), "alignment matrix"))


def align(
    model: Model,
    *,
    up: str = "auto",
    front: str | None = None,
    method: str = "npca",
    fold: Fold = "auto",
    seed: int = 0,
) -> Alignment:
    """Find the canonical frame of a model.

    Parameters
    ----------
    model:
        As loaded.
    up:
        The model direction that points up (:func:`popsim.mesh.axes.direction_of`), or "auto".
    front:
        The model direction that points to +x, as nearly as the heading allows; None to choose by the custom of
        the format and the shape.
    method:
        "npca": normals; "edges": long edges; "none": the model's own axes; or an angle such as "30deg", by which
        the model's own axes are turned, counterclockwise seen from above.
    fold:
        "auto": in the best mirror plane; "long" or "short": along that horizontal side.
    seed:
        Of the sample points.

    Raises
    ------
    MeshError
        An option has an unknown value, or `front` is the up axis.
    """
    return next(_alignments(model, up, front, method, fold, seed))


def alignments(
    model: Model,
    *,
    up: str = "auto",
    front: str | None = None,
    method: str = "npca",
    fold: Fold = "auto",
    seed: int = 0,
) -> tuple[Alignment, ...]:
    """Find the canonical frame of a model, and that with the other fold where it is as good a guess.

    Parameters and errors are those of :func:`align`, whose result comes first.
    """
    return tuple(_alignments(model, up, front, method, fold, seed))


def _alignments(
    model: Model, up: str, front: str | None, method: str, fold: Fold, seed: int
) -> Iterator[Alignment]:
    check_options(up, front, method, fold)
    choice = _up(model, up, seed)
    ahead = None if front is None else direction_of(front, "front")
    if ahead is not None and abs(ahead @ choice.direction) > VERTICAL:
        raise MeshError(f"front: '{front}' is the up axis ({choice.name}); choose a horizontal axis")
    basis = horizontal_basis(choice.direction)
    peaks, why_heading = _headings(model.surface, basis, method)
    level = levelled(model.surface, basis, peaks, SAMPLES, seed)
    heading = choose_heading(level, fixed=method not in ("npca", "edges"))
    reasons = (
        f"{choice.reason} (confidence {choice.confidence:.2f})",
        f"{why_heading} (confidence {heading.confidence:.2f})",
    )
    level_front = None if ahead is None else level.rotation @ ahead
    along, why = _fold_side(heading, fold, level_front)
    if level_front is not None:
        facing = stated_front(heading.directions[along], level_front, str(front))
        yield _over_fold(level, heading, along, choice, facing, (*reasons, why))
        return
    custom = format_of(model.path).front
    facing = choose_front(level, heading.directions[along], custom)
    yield _over_fold(level, heading, along, choice, facing, (*reasons, why))
    if fold == "auto" and _open(heading, along):
        other = 1 - along
        facing = choose_front(level, heading.directions[other], custom)
        score = heading.planes[along].score
        why = f"the fold runs where the pop-up shows more of the model; mirror score {score:.2f} of 1"
        yield _over_fold(level, heading, other, choice, facing, (*reasons, why))


def _over_fold(
    level: Level, heading: Heading, along: int, choice: UpChoice, facing: FrontChoice, reasons: tuple[str, ...]
) -> Alignment:
    """Align a model with the fold along one of the directions of its heading."""
    x = facing.direction
    turned = np.stack([x, np.cross([0.0, 0.0, 1.0], x), [0.0, 0.0, 1.0]])
    plane = heading.planes[1 - along]
    matrix, box = _stand(level, turned, plane)
    own = MirrorPlane(plane.normal @ level.rotation, plane.offset, plane.score, plane.centred)
    axes = (axis_name(matrix[0, :3]), axis_name(matrix[1, :3]), axis_name(matrix[2, :3]))
    reasons = (
        *reasons,
        f"{facing.reason} (confidence {facing.confidence:.2f})",
        *(str(part) for part in box.left_out),
    )
    fold: Side = "long" if along == _longer(heading) else "short"
    return Alignment(matrix, axes, fold, choice, heading.confidence, facing.confidence, own, box, reasons)


def check_options(up: str, front: str | None, method: str, fold: str) -> None:
    """Raise MeshError where an option of :func:`align` has an unknown value."""
    if up != "auto":
        direction_of(up, "up")
    if front is not None:
        direction_of(front, "front")
    if method not in METHODS:
        _turn_of(method)
    if fold not in FOLDS:
        raise MeshError(f"fold: '{fold}' is unknown; expected one of {', '.join(FOLDS)}")


def _turn_of(method: str) -> float:
    """Return the angle that an align option states, radians."""
    match = re.fullmatch(r"([+-]?[0-9]*\.?[0-9]+)\s*deg", method)
    if match is None:
        raise MeshError(
            f"align: '{method}' is unknown; expected one of {', '.join(METHODS)}, or an angle such as 30deg"
        )
    return float(np.radians(float(match[1])))


def _up(model: Model, up: str, seed: int) -> UpChoice:
    if up != "auto":
        return stated_up(up)
    samples = sample_surface(model.surface, SAMPLES, seed=seed)
    return set_on_edge(model.surface, samples, choose_up(model.surface, samples, format_of(model.path).up))


def _headings(surface: Surface, basis: FloatArray, method: str) -> tuple[list[Peak], str]:
    """Return the headings that the shape or the user suggests, relative to `basis`, and in words."""
    if method == "npca":
        return normal_headings(surface, basis), "the heading is that of most of the normals (NPCA)"
    if method == "edges":
        return edge_headings(surface, basis), "the heading is that of the long edges"
    if method == "none":
        return [Peak(0.0, 1.0)], "the heading is that of the model's own axes"
    return [Peak(_turn_of(method), 1.0)], f"the heading is that of the model's own axes turned by {method}"


def _fold_side(heading: Heading, fold: Fold, front: FloatArray | None) -> tuple[int, str]:
    """Return along which of the two horizontal directions the fold runs, and why."""
    first, second = heading.extents
    longer = _longer(heading)
    scores = _scores(heading)
    if front is not None:
        along = int(np.abs(heading.directions @ front).argmax())
        return along, f"the fold runs to the front; mirror score {scores[along]:.2f}"
    if fold != "auto":
        along = longer if fold == "long" else 1 - longer
        return along, f"the fold runs along the {fold} side, as told; mirror score {scores[along]:.2f}"
    better = 0 if scores[0] >= scores[1] else 1
    unequal = max(scores) > ASYMMETRIC and abs(scores[0] - scores[1]) > EQUAL_SYMMETRY
    if unequal or max(first, second) < SQUARE * min(first, second):
        return better, f"the fold lies in the best mirror plane, score {scores[better]:.2f} of 1"
    return longer, f"the fold runs along the longer side; mirror score {scores[longer]:.2f} of 1"


def _open(heading: Heading, along: int) -> bool:
    """Whether the fold could as well run along the other direction."""
    scores, extents = _scores(heading), heading.extents
    neither = max(scores) < ASYMMETRIC
    return neither or scores[1 - along] > WELL or extents[1 - along] > LONGER * extents[along]


def _longer(heading: Heading) -> int:
    return 0 if heading.extents[0] >= heading.extents[1] else 1


def _scores(heading: Heading) -> tuple[float, float]:
    """Mirror scores of the planes that contain each of the two directions."""
    return heading.planes[1].score, heading.planes[0].score


def _stand(level: Level, turned: FloatArray, plane: MirrorPlane) -> tuple[FloatArray, RobustBounds]:
    """Shift the turned model onto the base; return the whole motion and the box there."""
    box = level.body.box(turned)
    middle = plane.offset * np.sign(plane.normal @ turned[1])
    shift = -np.array([box.bounds[:, 0].mean(), middle, box.bounds[0, 2]])
    matrix = np.eye(4)
    matrix[:3, :3] = _tidy(turned @ level.rotation)
    matrix[:3, 3] = shift
    return matrix, box.shifted(shift)


def _tidy(rotation: FloatArray) -> FloatArray:
    """Round what arithmetic left of exact zeros and ones."""
    rounded = np.round(rotation)
    return np.where(np.abs(rotation - rounded) < 1e-9, rounded + 0.0, rotation)
