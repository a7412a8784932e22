"""Mechanisms drawn into the views of a model as contours will leave them: much of it once for many candidates."""

from collections.abc import Hashable, Sequence
from typing import TypeVar

import numpy as np

from popsim.fitting.crossing import Overhang, crossed, overhangs, without
from popsim.fitting.fronts import Fronts
from popsim.fitting.kernels.records import FloatImage, Line
from popsim.fitting.mirror import Mirror, Sides, lies_beyond, same_on_both_sides
from popsim.fitting.shape import shape_of
from popsim.fitting.stencil import Stencil
from popsim.fitting.views import Picture, Views
from popsim.mechanisms import Depths, Mechanism, Plate, plates_together

PLATES, STENCILS, MECHANISMS = 4000, 2000, 64
"""How many pictures of plates, stencils and pictures of mechanisms are remembered; candidates differ in few."""

Key = TypeVar("Key", bound=Hashable)
T = TypeVar("T")


class Drawing:
    """Draws mechanisms, held against a model seen from its axes, into views.

    Attributes
    ----------
    views, fronts:
        What is drawn into, and the model.
    mirror:
        What takes pictures to the other side of the fold, where the model is the same on both.
    """

    def __init__(self, views: Views, fronts: Fronts) -> None:
        self.views, self.fronts = views, fronts
        self.mirror = Mirror.of(views) if same_on_both_sides(fronts) else None
        self.plates: dict[tuple[bytes, tuple[Line, ...]], Picture] = {}
        self.stencils: dict[bytes, tuple[Stencil, tuple[Overhang, ...]]] = {}
        self.wholes: dict[tuple[bytes, ...], list[Picture]] = {}

    def drawn(self, mechanisms: Sequence[Mechanism], depths: Depths) -> tuple[FloatImage, bool]:
        """Draw mechanisms with factors on the depths of their plates.

        Returns
        -------
        tuple
            How far they are from the eye in each pixel of each view, shape (views, n, n), inf where there is
            nothing, until anything else is drawn, and whether these are but the views that tell all
            (:attr:`Mirror.once`).
        """
        together = plates_together(mechanisms, depths).values()
        every = [Sides.of(plates, even=self.mirror is not None) for plates in together]
        uneven = [sides for sides in every if not sides.even]
        depth = self.views.canvas
        depth.fill(np.inf)
        self._draw([sides for sides in every if sides.even], depth)
        if self.mirror is not None:
            depth = self.mirror.both(depth, np.arange(len(depth)) if uneven else self.mirror.once)
        self._draw(uneven, depth)
        return depth, self.mirror is not None and not uneven

    def _draw(self, mechanisms: Sequence[Sides], depth: FloatImage) -> None:
        from popsim.fitting.kernels.pictures import paint

        for sides in mechanisms:
            for picture in self._whole(sides):
                paint(depth, *picture)

    def _whole(self, sides: Sides) -> list[Picture]:
        """All plates of a mechanism."""
        found = self.wholes.get(sides.key)
        if found is None:
            found = self._pictures(sides.plates)
            _keep(self.wholes, sides.key, found, MECHANISMS)
        return found

    def _pictures(self, plates: Sequence[Plate]) -> list[Picture]:
        """The plates of a mechanism in all views; of two that cross beyond a hinge one ends there."""
        across = [self._across(plate) for plate in plates]
        found = []
        for side in sorted(set(across)):
            own = [plate for plate, other in zip(plates, across, strict=True) if other is side]
            cut = crossed([self._stencil(plate)[1] for plate in own])
            found += [self.picture(plate, cut.get(place, ())) for place, plate in enumerate(own)]
        return found

    def picture(self, plate: Plate, cut: tuple[Line, ...] = ()) -> Picture:
        """A plate in all views, with nothing beyond some lines; it depends on nothing but its shape."""
        across = self._across(plate)
        key = shape_of(plate, across=across).key, cut
        found = self.plates.get(key)
        if found is None:
            found = self.views.drawn(without(self._stencil(plate)[0], cut))
            _keep(self.plates, key, found, PLATES)
        return self.mirror.image(found) if self.mirror is not None and across else found

    def _stencil(self, plate: Plate) -> tuple[Stencil, tuple[Overhang, ...]]:
        """Where a plate, or its mirror image where that is drawn, shows the model, and beyond which hinges."""
        shape = shape_of(plate, across=self._across(plate))
        found = self.stencils.get(shape.key)
        if found is None:
            stencil = Stencil.of(shape, self.fronts)
            found = stencil, overhangs(shape, stencil)
            _keep(self.stencils, shape.key, found, STENCILS)
        return found

    def _across(self, plate: Plate) -> bool:
        """Whether the mirror image of a plate is drawn instead."""
        return self.mirror is not None and lies_beyond(plate)


def _keep(known: dict[Key, T], key: Key, found: T, most: int) -> None:
    """Remember something, and forget the oldest where there is too much."""
    if len(known) >= most:
        known.pop(next(iter(known)))
    known[key] = found
