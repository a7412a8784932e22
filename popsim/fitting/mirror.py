"""Models that are the same on both sides of the fold: what a plate shows there is worked out on one side only."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from popsim.fitting.fronts import Fronts
from popsim.fitting.views import Drawn, Views
from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Plate

UNLIKE = 0.005
"""Share of what a model shows along the axes that may differ from its mirror image, for it to be the same."""

CENTRED = 1e-6
"""By how much, as a share of its size, a box may lie off the fold and still count as the same on both sides."""

DIGITS = 6
"""Decimals of mm by which corners are told apart."""

ACROSS = np.array([1.0, -1.0, 1.0])
"""Takes points to the other side of the fold."""


def same_on_both_sides(fronts: Fronts) -> bool:
    """Whether a model is its own mirror image at the plane y = 0, as far as its fronts tell."""
    low, high = fronts.bounds
    if abs(low[1] + high[1]) > CENTRED * (high - low).max():
        return False
    (front, back), (left, right), (top, bottom) = fronts.maps
    pairs = [
        (front, front[::-1]),
        (back, back[::-1]),
        (left, right),
        (top, top[:, ::-1]),
        (bottom, bottom[:, ::-1]),
    ]
    unlike = sum(_unlike(one, other, fronts.pixel) for one, other in pairs)
    return unlike <= UNLIKE * sum(np.count_nonzero(np.isfinite(one)) for one, _ in pairs)


def _unlike(one: FloatArray, other: FloatArray, pixel: float) -> int:
    """In how many pixels only one of two maps shows something, or both at depths farther apart than a pixel."""
    shown, also = np.isfinite(one), np.isfinite(other)
    with np.errstate(invalid="ignore"):  # where both show nothing
        apart = np.abs(one - other) > pixel
    return int(np.count_nonzero((shown != also) | (shown & also & apart)))


def lies_beyond(plate: Plate) -> bool:
    """Whether a plate lies on the far side of the fold (y < 0), for the greater part."""
    return bool(plate.outline[:, 1].sum() < 0)


def mirrored(plate: Plate) -> Plate:
    """A plate on the other side of the fold."""
    assert plate.room is not None  # plates give themselves room
    return replace(
        plate,
        outline=plate.outline * ACROSS,
        room=plate.room * ACROSS,
        outward=plate.outward * ACROSS,
        hinges=plate.hinges * ACROSS,
    )


@lru_cache(maxsize=8192)
def shape_of(plate: Plate, *, across: bool) -> bytes:
    """What tells a plate from others by how it shows a model, or its mirror image where `across`."""
    assert plate.room is not None  # plates give themselves room
    turn = ACROSS if across else np.ones(3)
    rings = [_ring(turn * ring) for ring in (plate.outline, plate.room)]
    rest = np.round([*(turn * plate.outward), plate.behind, plate.beside, plate.principal], DIGITS) + 0.0
    hinges = np.round(turn * plate.hinges, DIGITS) + 0.0
    return b"".join([*rings, rest.tobytes(), hinges.tobytes()])


def _ring(points: FloatArray) -> bytes:
    """Corners of a ring from its least one on, to the side of the lesser neighbour: whatever way it is listed."""
    corners = [tuple(point) for point in (np.round(points, DIGITS) + 0.0).tolist()]
    first = min(range(len(corners)), key=corners.__getitem__)
    turned = corners[first:] + corners[:first]
    if turned[-1] < turned[1]:
        turned[1:] = turned[:0:-1]
    return np.array(turned).tobytes()


@dataclass(frozen=True)
class Mirror:
    """Pictures of one side of the fold turned into those of the other.

    Attributes
    ----------
    views:
        For each view the one that sees its mirror image, left and right exchanged.
    pixels:
        Of a row.
    """

    views: tuple[int, ...]
    pixels: int

    @staticmethod
    def of(views: Views) -> "Mirror":
        """For views of a box that is the same on both sides of the fold."""
        eyes = views.axes[:, 2]
        apart = np.linalg.norm(eyes[:, None] - eyes * ACROSS, axis=-1)
        return Mirror(tuple(int(view) for view in apart.argmin(axis=1)), views.pixels)

    def image(self, pictures: list[Drawn]) -> list[Drawn]:
        """The pictures of what is on the other side."""
        return [
            Drawn(
                self.views[view],
                rows,
                slice(self.pixels - columns.stop, self.pixels - columns.start),
                depth[:, ::-1],
            )
            for view, rows, columns, depth in pictures
        ]
