"""Mechanisms drawn into the views of a model as contours will leave them: much of it once for many candidates."""

from collections.abc import Hashable, Sequence
from typing import TypeVar

import numpy as np

from popsim.fitting.crossing import Overhang, crossed, overhangs, without
from popsim.fitting.fronts import Fronts
from popsim.fitting.lines import Line
from popsim.fitting.masks import FAR, FloatImage
from popsim.fitting.mirror import Mirror, Sides, lies_beyond, plain, same_on_both_sides, shape_of
from popsim.fitting.stencil import Stencil
from popsim.fitting.views import Drawn, Views, flattened
from popsim.mechanisms import Depths, Mechanism, Plate, plates_together

PLATES, STENCILS, MECHANISMS = 4000, 1000, 64
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
        self.plates: dict[tuple[bytes, tuple[Line, ...]], list[Drawn]] = {}
        self.stencils: dict[bytes, tuple[Stencil, tuple[Overhang, ...]]] = {}
        self.wholes: dict[tuple[bytes, ...], list[Drawn]] = {}
        self.asked: set[tuple[bytes, ...]] = set()

    def drawn(self, mechanisms: Sequence[Mechanism], depths: Depths) -> tuple[FloatImage, bool]:
        """Draw mechanisms with factors on the depths of their plates.

        Returns
        -------
        tuple
            How far they are from the eye in each pixel of each view, shape (views, n, n), inf where there is
            nothing, and whether these are but the views that tell all (:attr:`Mirror.once`).
        """
        together = plates_together(mechanisms, depths).values()
        every = [Sides.of(plates, even=self.mirror is not None) for plates in together]
        uneven = [sides for sides in every if not sides.even]
        depth = np.full((len(self.views.axes), self.views.pixels, self.views.pixels), FAR)
        self._draw([sides for sides in every if sides.even], depth)
        if self.mirror is not None:
            depth = self.mirror.both(depth, range(len(depth)) if uneven else self.mirror.once)
        self._draw(uneven, depth)
        return depth, self.mirror is not None and not uneven

    def _draw(self, mechanisms: Sequence[Sides], depth: FloatImage) -> None:
        for sides in mechanisms:
            for view, rows, columns, there in self._whole(sides):
                part = depth[view, rows, columns]
                np.minimum(part, there, out=part)

    def _whole(self, sides: Sides) -> list[Drawn]:
        """All plates of a mechanism; as one picture for each view from the second time on."""
        found = self.wholes.get(sides.key)
        if found is None:
            found = self._pictures(sides.plates)
            if sides.key in self.asked:
                found = flattened(found)
                _keep(self.wholes, sides.key, found, MECHANISMS)
            self.asked.add(sides.key)
        return found

    def _pictures(self, plates: Sequence[Plate]) -> list[Drawn]:
        """The plates of a mechanism in all views; of two that cross beyond a hinge one ends there."""
        across = [self._across(plate) for plate in plates]
        found: list[Drawn] = []
        for side in sorted(set(across)):
            own = [plate for plate, other in zip(plates, across, strict=True) if other is side]
            cut = crossed([self._stencil(plate)[1] for plate in own])
            for place, plate in enumerate(own):
                found += self.picture(plate, cut.get(place, ()))
        return found

    def picture(self, plate: Plate, cut: tuple[Line, ...] = ()) -> list[Drawn]:
        """A plate in all views, with nothing beyond some lines; it depends on nothing but its shape."""
        across = self._across(plate)
        key = shape_of(plate, across=across), cut
        found = self.plates.get(key)
        if found is None:
            found = self.views.drawn(without(self._stencil(plate)[0], cut))
            _keep(self.plates, key, found, PLATES)
        return self.mirror.image(found) if self.mirror is not None and across else found

    def _stencil(self, plate: Plate) -> tuple[Stencil, tuple[Overhang, ...]]:
        """Where a plate, or its mirror image where that is drawn, shows the model, and beyond which hinges."""
        across = self._across(plate)
        key = shape_of(plate, across=across)
        found = self.stencils.get(key)
        if found is None:
            own = plain(plate, across=across)
            stencil = Stencil.of(own, self.fronts)
            found = stencil, overhangs(own, stencil)
            _keep(self.stencils, key, found, STENCILS)
        return found

    def _across(self, plate: Plate) -> bool:
        """Whether the mirror image of a plate is drawn instead."""
        return self.mirror is not None and lies_beyond(plate)


def _keep(known: dict[Key, T], key: Key, found: T, most: int) -> None:
    """Remember something, and forget the oldest where there is too much."""
    if len(known) >= most:
        known.pop(next(iter(known)))
    known[key] = found
