"""What there is to draw in a scene of the assembly: parts, flaps, places for flaps."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING

from popsim.assembly import FlapKey, Scene, flap_key
from popsim.booklet.cutout import Cutout, cutout, flap_cutout, part_cutouts
from popsim.booklet.sight import Plate, Seen, see
from popsim.booklet.stacking import LEVEL, NEAR, stacked
from popsim.design import BACKDROP_ID, GROUND_ID
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane
from popsim.geometry.rigid import translation
from popsim.layout import Face, Flap, Layout

if TYPE_CHECKING:
    from popsim.rendering.view import View

FLAP_LIFT, PLACE_LIFT = 0.1, 0.05
"""mm; flaps are drawn this far off the paper that they lie on, and the places for them nearly on it."""


class Kind(Enum):
    """What a thing is."""

    PAGE = "page"
    PART = "part"
    FLAP = "flap"
    PLACE = "place"


@dataclass(frozen=True, eq=False)
class Thing:
    """Something to draw.

    Attributes
    ----------
    kind:
        What it is.
    name:
        Id of the part it is or is on.
    plate:
        Where it is.
    new:
        Whether it stands out.
    flap:
        The flap that it is or that it is the place for, if that is glued in this step, else None.
    """

    kind: Kind
    name: str
    plate: Plate
    new: bool = False
    flap: Flap | None = None

    def glue_side(self, printed: bool) -> bool:
        """Whether the printed side (or the reverse) is the one with the glue."""
        if self.flap is None:
            return False
        return printed == (self.flap.glue_on_print if self.kind is Kind.FLAP else self.flap.face is Face.PRINTED)


@dataclass(frozen=True, eq=False)
class Sight:
    """A thing and what is seen of it."""

    thing: Thing
    seen: Seen


@dataclass(frozen=True, eq=False)
class Eye:
    """Looks at scenes of one layout along the rays of one view."""

    layout: Layout
    view: "View"

    @cached_property
    def parts(self) -> dict[str, Cutout]:
        """Cutouts of all parts."""
        return part_cutouts(self.layout)

    @cached_property
    def flaps(self) -> dict[FlapKey, tuple[Flap, Cutout, Cutout]]:
        """All flaps, with the cutouts of themselves and of their places."""
        return {flap_key(flap): (flap, flap_cutout(flap), cutout(flap.landing, [])) for flap in self.layout.flaps}

    def ends(self, key: FlapKey) -> tuple[str, str]:
        """Ids of the parts that a flap joins: its carrier and its target."""
        flap = self.flaps[key][0]
        return flap.carrier, flap.target

    def look(self, scene: Scene, new: Collection[str] = (), glued: Collection[FlapKey] = ()) -> tuple[Sight, ...]:
        """What is seen of a scene; parts in `new` stand out, flaps in `glued` show where they are glued."""
        shifts = stacked(scene, self.layout, self.parts)
        planes = {
            name: self.layout.parts[name].plane.moved(translation(shifts[name]) @ pose)
            for name, pose in scene.poses.items()
        }
        flaps = {key: self._flap_plane(key, scene, shifts) for key in scene.flaps}
        things = [*self._parts(planes, new), *self._flaps(flaps, new, glued), *self._places(planes, new, glued)]
        shines = [thing.new or thing.flap is not None for thing in things]
        plates = [replace(thing.plate, shines=own) for thing, own in zip(things, shines, strict=True)]
        seen = see(plates, self.view)
        return tuple(Sight(thing, own) for thing, own in zip(things, seen, strict=True))

    def _parts(self, planes: Mapping[str, Plane], new: Collection[str]) -> Iterator[Thing]:
        for name, plane in planes.items():
            page = self.layout.parts[name].patch.id in (GROUND_ID, BACKDROP_ID)
            yield Thing(Kind.PAGE if page else Kind.PART, name, Plate(self.parts[name], plane), name in new)

    def _flaps(
        self, planes: Mapping[FlapKey, Plane], new: Collection[str], glued: Collection[FlapKey]
    ) -> Iterator[Thing]:
        for key, plane in planes.items():
            flap, shape, _ = self.flaps[key]
            active = flap if key in glued else None
            yield Thing(Kind.FLAP, flap.carrier, Plate(shape, plane), flap.carrier in new, active)

    def _places(
        self, planes: Mapping[str, Plane], new: Collection[str], glued: Collection[FlapKey]
    ) -> Iterator[Thing]:
        for key in glued:
            flap, _, shape = self.flaps[key]
            if flap.target in planes:
                plane = planes[flap.target]
                lifted = plane.moved(translation(_lift(flap, plane, PLACE_LIFT)))
                yield Thing(Kind.PLACE, flap.target, Plate(shape, lifted), flap.target in new, flap)

    def _flap_plane(self, key: FlapKey, scene: Scene, shifts: Mapping[str, FloatArray]) -> Plane:
        """Where a flap is drawn: a little off the target on which it lies, else where its carrier is."""
        flap = self.flaps[key][0]
        plane = self.layout.parts[flap.carrier].plane.moved(scene.flaps[key])
        if flap.target in scene.poses:
            target = self.layout.parts[flap.target].plane.moved(scene.poses[flap.target])
            if abs(plane.normal @ target.normal) > LEVEL and abs(target.distance(plane.origin)) < NEAR:
                return plane.moved(translation(shifts[flap.target] + _lift(flap, target, FLAP_LIFT)))
        return plane.moved(translation(shifts[flap.carrier]))


def _lift(flap: Flap, target: Plane, height: float) -> FloatArray:
    """Shift (3,) off the face of the target that a flap is glued to, mm."""
    return height * target.normal * (1 if flap.face is Face.PRINTED else -1)
