"""Models that are the same on both sides of the fold: what a plate shows there is worked out on one side only."""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np

from popsim.fitting.fronts import SHIFTED, Fronts, alike
from popsim.fitting.kernels.records import FloatImage
from popsim.fitting.shape import ACROSS, shape_of
from popsim.fitting.views import Picture, Views
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.mechanisms import Plate

ON_FOLD = 1e-6
"""mm; corners nearer to the plane over the fold lie in it."""


def same_on_both_sides(fronts: Fronts) -> bool:
    """Whether a model is its own mirror image at the plane y = 0, as far as its fronts tell."""
    low, high = fronts.bounds
    if abs(low[1] + high[1]) > SHIFTED * (high - low).max():
        return False
    (front, back), (left, right), (top, bottom) = fronts.maps
    pairs = [
        (front, front[::-1]),
        (back, back[::-1]),
        (left, right),
        (top, top[:, ::-1]),
        (bottom, bottom[:, ::-1]),
    ]
    return alike(pairs, fronts.pixel)


@lru_cache(maxsize=8192)
def lies_beyond(plate: Plate) -> bool:
    """Whether a plate lies on the far side of the fold (y < 0), for the greater part."""
    return bool(plate.outline[:, 1].sum() < 0)


@dataclass(frozen=True, eq=False)
class Mirror:
    """Pictures of one side of the fold turned into those of the other.

    Attributes
    ----------
    views:
        For each view the one that sees its mirror image, left and right exchanged, shape (v,).
    pixels:
        Of a row.
    """

    views: IntArray
    pixels: int

    @staticmethod
    def of(views: Views) -> "Mirror":
        """For views of a box that is the same on both sides of the fold."""
        eyes = views.axes[:, 2]
        apart = np.linalg.norm(eyes[:, None] - eyes * ACROSS, axis=-1)
        return Mirror(apart.argmin(axis=1), views.pixels)

    @cached_property
    def once(self) -> IntArray:
        """Views of which no other is the mirror image: they tell all of what is the same on both sides, (k,)."""
        return np.flatnonzero(np.arange(len(self.views)) <= self.views)

    @cached_property
    def weights(self) -> FloatArray:
        """For how many views each of these stands, shape (k,)."""
        return np.where(self.views[self.once] == self.once, 1.0, 2.0)

    def image(self, picture: Picture) -> Picture:
        """The picture of what is on the other side."""
        from popsim.fitting.kernels.pictures import mirrored

        return Picture(*mirrored(*picture, self.views, self.pixels))

    def both(self, near: FloatImage, views: IntArray) -> FloatImage:
        """Some views of what is on both sides, (k, n, n), until they are next asked for; from all of one side."""
        from popsim.fitting.kernels.pictures import both_sides

        found = self._canvas[: len(views)]
        both_sides(near, views, self.views, found)
        return found

    @cached_property
    def _canvas(self) -> FloatImage:
        return np.empty((len(self.views), self.pixels, self.pixels), dtype=np.float32)


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
        near = {shape_of(plate, across=False).key: plate for plate in plates if not (even and lies_beyond(plate))}
        far = {shape_of(plate, across=True).key: plate for plate in plates if even and lies_beyond(plate)}
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
