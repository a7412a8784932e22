"""Random fins: plates inside that rise above the top they carry, through a slit in it."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.random import Generator

from popsim.design import Card
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane
from popsim.geometry.rigid import transform
from popsim.mechanisms import Joint, Mechanism, Plate, Shape, plates_together
from popsim.mechanisms.attach import SHORTEST
from popsim.mechanisms.room import LEAST, draw, draw_interval
from popsim.patches.slits import PLAY, WIDTH

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

FIN_SHARE = 0.5
"""How often a fin rises where there is room for one."""

TALLEST = 60.0
"""mm; the most by which a fin rises."""

MARGIN = 1.0
"""mm that a closed card keeps above a fin."""

LEAST_AREA = 10.0
"""mm^2; less is no fin."""

INSIDE = 1.0
"""mm by which a window on the room of a fin reaches back into the face that it rises from."""


def random_fins(rng: Generator, mechanisms: Sequence[Mechanism], card: Card) -> dict[str, Shape]:
    """Shapes with fins, and of what they rise through, by patch id; hinges stay where they are."""
    together = plates_together(mechanisms)
    shapes: dict[str, Shape] = {}
    for mechanism in mechanisms:
        plates = {plate.role: plate for plate in together[mechanism.id]}
        for joint, inside, outside in _ridges(mechanism, plates):
            names = [mechanism.patch_id(plate.role) for plate in (inside, outside)]
            if rng.random() < FIN_SHARE and not shapes.keys() & set(names):
                shapes |= dict(zip(names, _fin(rng, mechanism, joint, (inside, outside), card), strict=False))
    return shapes


def _ridges(mechanism: Mechanism, plates: Mapping[str, Plate]) -> Iterator[tuple[Joint, Plate, Plate]]:
    """Joints of a plate inside that carries one outside, with these two."""
    for joint in mechanism.joints():
        pair = [plates[role] for role in joint.roles if role in plates]
        pair.sort(key=lambda plate: plate.principal)
        if [plate.principal for plate in pair] == [False, True]:
            yield joint, pair[0], pair[1]


def _fin(
    rng: Generator, mechanism: Mechanism, joint: Joint, plates: tuple[Plate, Plate], card: Card
) -> tuple[Shape, ...]:
    """The plate inside with a fin, and the one outside with its slit; nothing where there is no room for one."""
    from shapely import box as block
    from shapely import get_parts, union_all
    from shapely.geometry import LineString, Polygon

    inside, outside = plates
    length = float(np.linalg.norm(joint.axis[1] - joint.axis[0]))
    if length < 2 * LEAST:
        return ()
    plane, host = _beside(joint.axis, inside), _beside(joint.axis, outside)
    room, face = (Polygon(plane.flat(ring)) for ring in (inside.left, inside.outline))
    start, end = draw_interval(rng, 0.0, length)
    window = Polygon([(start, -INSIDE), (end, -INSIDE), (end, draw(rng, LEAST, TALLEST)), (start, LEAST)])
    whole = face.union(room.intersection(window))
    slits = [
        block(part.bounds[0] - PLAY, -WIDTH, part.bounds[2] + PLAY, INSIDE)
        for part in get_parts(whole.difference(face))
        if part.area > 0
    ]
    left = Polygon(host.flat(outside.outline)).difference(union_all(slits))
    crease = get_parts(LineString([(0.0, 0.0), (length, 0.0)]).difference(union_all(slits)))
    if max((part.length for part in crease), default=0.0) < SHORTEST:
        return ()
    if not (_is_ring(whole) and _is_ring(left)) or whole.area < face.area + LEAST_AREA:
        return ()
    fin, slotted = (
        Shape(plane.lift(np.array(shape.exterior.coords)[:-1])) for plane, shape in ((plane, whole), (host, left))
    )
    return (fin, slotted) if _stays_inside(mechanism, inside.role, fin.outline, card) else ()


def _is_ring(shape: "BaseGeometry") -> bool:
    """Whether it is one polygon without holes."""
    return shape.geom_type == "Polygon" and not getattr(shape, "interiors", ())


def _stays_inside(mechanism: Mechanism, role: str, outline: FloatArray, card: Card) -> bool:
    """Whether an outline stays on the page when the card is closed."""
    closed = transform(mechanism.poses(np.zeros(1))[role], outline)[0]
    return bool(np.abs(closed[:, 2]).max() <= card.depth - MARGIN)


def _beside(axis: FloatArray, plate: Plate) -> Plane:
    """The plane of a plate with axes along a line of it, from its first end, and away from the plate beyond it."""
    along = (axis[1] - axis[0]) / np.linalg.norm(axis[1] - axis[0])
    beyond = np.cross(Plane.through(plate.outline).normal, along)
    beyond *= -np.sign((plate.outline - axis[0]).mean(axis=0) @ beyond)
    return Plane(axis[0], along, beyond)
