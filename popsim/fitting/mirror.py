"""Models that are the same on both sides of the fold: what a plate shows there is worked out on one side only."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np

from popsim.fitting.fronts import Fronts
from popsim.fitting.masks import FloatImage
from popsim.fitting.views import Drawn, Views
from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Plate

UNLIKE = 0.005
"""Share of what a model shows along the axes that may differ from its mirror image, for it to be the same."""

CENTRED = 1e-6
"""By how much, as a share of its size, a box may lie off the fold and still count as the same on both sides."""

DIGITS = 6
"""Decimals of mm by which corners are told apart."""

ON_FOLD = 1e-6
"""mm; corners nearer to the plane over the fold lie in it."""

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


def shape_of(plate: Plate, *, across: bool) -> bytes:
    """What tells a plate from others by how it shows a model, or its mirror image where `across`."""
    return b"".join(_listed(plate, across))


def plain(plate: Plate, *, across: bool) -> Plate:
    """A plate, or its mirror image, as its shape tells: the same for all of one shape."""
    outline, room, outward, hinges, rest = (np.frombuffer(part) for part in _listed(plate, across))
    return plate.but(
        outline=outline.reshape(-1, 3),
        room=room.reshape(-1, 3),
        outward=outward,
        hinges=hinges.reshape(-1, 2, 3),
        behind=float(rest[0]),
        beside=float(rest[1]),
    )


@lru_cache(maxsize=8192)
def _listed(plate: Plate, across: bool) -> tuple[bytes, ...]:
    """Outline, room, outward, hinges and the rest of a plate, rounded and listed in one way."""
    assert plate.room is not None  # plates give themselves room
    places = np.concatenate([plate.outline, plate.room, plate.hinges.reshape(-1, 3), plate.outward[None]])
    points = (np.round(places * ACROSS if across else places, DIGITS) + 0.0).tolist()
    first, second = len(plate.outline), len(plate.outline) + len(plate.room)
    ends = points[second:-1]
    hinges = sorted({(*low, *high) for low, high in (sorted(ends[k : k + 2]) for k in range(0, len(ends), 2))})
    rest = round(plate.behind, DIGITS), round(plate.beside, DIGITS), float(plate.principal)
    parts = _ring(points[:first]), _ring(points[first:second]), points[-1], hinges, rest
    return tuple(np.array(part, dtype=np.float64).tobytes() for part in parts)


def _ring(corners: list[list[float]]) -> list[list[float]]:
    """Corners of a ring from its least one on, to the side of the lesser neighbour: whatever way it is listed."""
    first = corners.index(min(corners))
    turned = corners[first:] + corners[:first]
    return [turned[0], *turned[:0:-1]] if turned[-1] < turned[1] else turned


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

    @cached_property
    def once(self) -> tuple[int, ...]:
        """Views of which no other is the mirror image: they tell all of what is the same on both sides."""
        return tuple(view for view, other in enumerate(self.views) if view <= other)

    @cached_property
    def weights(self) -> FloatArray:
        """For how many views each of these stands, shape (k,)."""
        return np.array([1.0 if self.views[view] == view else 2.0 for view in self.once])

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

    def both(self, near: FloatImage, views: Sequence[int]) -> FloatImage:
        """Depths of what is on both sides in some views, from those (views, n, n) of one side in all."""
        images = near[[self.views[view] for view in views], :, ::-1]
        return np.minimum(near[list(views)], images, out=images)


class Sides(NamedTuple):
    """What is drawn of a mechanism.

    Attributes
    ----------
    plates:
        Its plates; of an even one those that do not lie beyond the fold only.
    even:
        Whether all others are mirror images of these.
    key:
        What tells them from others by how they show a model.
    """

    plates: tuple[Plate, ...]
    even: bool
    key: tuple[bytes, ...]

    @staticmethod
    @lru_cache(maxsize=2048)
    def of(plates: tuple[Plate, ...], *, even: bool) -> "Sides":
        """The sides of a mechanism, beside a model that may be `even`, the same on both sides of the fold."""
        near = {shape_of(plate, across=False): plate for plate in plates if not (even and lies_beyond(plate))}
        far = {shape_of(plate, across=True): plate for plate in plates if even and lies_beyond(plate)}
        if (
            even
            and far.keys() <= near.keys()
            and all(key in far or _on_fold(plate) for key, plate in near.items())
        ):
            return Sides(tuple(near.values()), True, tuple(near))
        return Sides(plates, False, (b"uneven", *near, b"beyond", *far))


def _on_fold(plate: Plate) -> bool:
    """Whether a plate lies in the plane over the fold, so that it is its own mirror image."""
    assert plate.room is not None  # plates give themselves room
    return all(float(np.abs(ring[:, 1]).max()) < ON_FOLD for ring in (plate.outline, plate.room))
