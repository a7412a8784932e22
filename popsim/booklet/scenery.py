"""A scene as it is seen, with what is said about it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from popsim.booklet.labels import Wish
from popsim.booklet.shapes import untied
from popsim.booklet.things import Kind, Sight
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import GRID, move_shape
from popsim.layout import Face

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapely.geometry.base import BaseGeometry

NUMBER, NAME = 2.3, 2.3
"""mm; font sizes of the numbers of flaps and of the names of pieces."""


@dataclass(frozen=True, eq=False)
class Scenery:
    """What a panel shows, in the plane coordinates of the view, mm.

    Attributes
    ----------
    sights:
        What is seen.
    tracks:
        Along which things move, each of shape (n, 2).
    names:
        Name of the piece by the ids of its parts, for the pieces that are labelled.
    numbers:
        Number of each glue joint by id, if flaps and places are labelled.
    """

    sights: tuple[Sight, ...]
    tracks: tuple[FloatArray, ...] = ()
    names: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    numbers: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))

    @cached_property
    def bounds(self) -> FloatArray:
        """Lowest and highest corner of all that is drawn, shape (2, 2)."""
        boxes = np.array([sight.seen.whole.bounds for sight in self.sights])
        ends = np.concatenate([*self.tracks, boxes[:, :2], boxes[:, 2:]])
        return np.array([ends.min(axis=0), ends.max(axis=0)])

    @cached_property
    def silhouette(self) -> "BaseGeometry":
        """All that is covered by paper; on a grid, so that it stays valid when it is moved."""
        import shapely

        shown = [sight.seen.whole for sight in self.sights if not sight.seen.area.is_empty]  # they hide the others
        return shapely.union_all(shown, grid_size=GRID)

    @property
    def glued(self) -> tuple[Sight, ...]:
        """The flaps and places that are glued in this step."""
        return tuple(sight for sight in self.sights if sight.thing.flap is not None)

    def name_wishes(self, motion: FloatArray) -> "Iterator[Wish]":
        """A label for each named piece, where most of it is seen."""
        largest: dict[str, BaseGeometry] = {}
        for sight in self.sights:
            name = self.names.get(sight.thing.name)
            if name is not None and sight.thing.kind in (Kind.PART, Kind.PAGE):
                area = sight.seen.area
                if name not in largest or area.area > largest[name].area:
                    largest[name] = area
        for name, area in largest.items():
            yield Wish(name, untied(move_shape(motion, area)), NAME)

    def number_wishes(self, motion: FloatArray) -> "Iterator[Wish]":
        """A label for each flap and each place that is glued; in brackets where it is printed so."""
        for sight in self.glued:
            flap = sight.thing.flap
            if flap is None or flap.joint.id not in self.numbers:
                continue
            number = str(self.numbers[flap.joint.id])
            behind = sight.thing.kind is Kind.PLACE and flap.face is Face.REVERSE
            seen = sight.seen.area if sight.seen.area.area > 0.3 * sight.seen.whole.area else sight.seen.whole
            yield Wish(f"({number})" if behind else number, untied(move_shape(motion, seen)), NUMBER, badge=True)
