"""Pieces: what is cut out in one go. A net with its flaps, one merged outline, creases, places for other flaps."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move, move_shape, without
from popsim.layout.contact import contacts
from popsim.layout.errors import LayoutError
from popsim.layout.flap import Flap
from popsim.layout.folding import Crease, bend, into
from popsim.layout.joints import Joint
from popsim.layout.nets import Net
from popsim.layout.parts import Part
from popsim.layout.sites import Face

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry

BRIDGE = 0.002
"""mm; paper added along creases so that outlines that meet but for rounding merge; far below a cutter's error."""

SHORTEST_SLIT = 0.2
"""mm; shorter cuts between parts that touch are left to the knife's width."""


@dataclass(frozen=True, eq=False)
class Fold:
    """A crease of a piece.

    Attributes
    ----------
    ends:
        Where it runs, shape (2, 2), piece coordinates.
    crease, joint:
        How it bends, and where that belongs to.
    parts:
        Ids of the part on one side of it, and of that with which the other side, a part or a flap, turns.
    face:
        Face of the latter part on the side to which that is printed.
    """

    ends: FloatArray
    crease: Crease
    joint: Joint
    parts: tuple[str, str]
    face: Face


@dataclass(frozen=True, eq=False)
class Piece:
    """A piece of paper as it is cut, printed side up, in its own flat coordinates, mm.

    Attributes
    ----------
    name:
        Printed on it and used in the assembly steps.
    motions:
        Flat motion (3, 3) of each of its parts, by part id.
    outline:
        What is cut round: parts and flaps in one, holes included.
    slits:
        Cuts inside the outline between parts that touch without being joined, each of shape (n, 2).
    folds:
        Creases between its parts and at its flaps.
    flaps:
        The flaps that it carries.
    places:
        The flaps of other pieces (or its own) that are glued to it.
    """

    name: str
    motions: Mapping[str, FloatArray]
    outline: "Polygon"
    slits: tuple[FloatArray, ...]
    folds: tuple[Fold, ...]
    flaps: tuple[Flap, ...]
    places: tuple[Flap, ...]


def make_pieces(parts: Mapping[str, Part], nets: tuple[Net, ...], flaps: tuple[Flap, ...]) -> tuple[Piece, ...]:
    """One piece per net, in the order of the nets."""
    names = piece_names([tuple(net.motions) for net in nets])
    return tuple(_piece(name, net, parts, flaps) for name, net in zip(names, nets, strict=True))


def piece_names(members: list[tuple[str, ...]]) -> list[str]:
    """A short unique name for each group of parts: the part's id, or what the ids have in common and a letter."""
    names: list[str] = []
    for ids in members:
        stem = ids[0].replace(".", "-")
        if len(ids) > 1:
            heads = [name.split(".")[0] for name in ids]
            stem = f"{heads[0]}-a" if len(set(heads)) == 1 and heads[0] != ids[0] else "+".join(ids[:2])
        names.append(_unused(stem, names))
    return names


def _unused(stem: str, names: list[str]) -> str:
    if stem not in names:
        return stem
    if stem.endswith("-a"):
        for letter in "bcdefghijklmnopqrstuvwxyz":
            if f"{stem[:-1]}{letter}" not in names:
                return f"{stem[:-1]}{letter}"
    return next(name for k in range(2, len(names) + 3) if (name := f"{stem}-{k}") not in names)


def _piece(name: str, net: Net, parts: Mapping[str, Part], flaps: tuple[Flap, ...]) -> Piece:
    carried = tuple(flap for flap in flaps if flap.carrier in net.motions)
    folds = (*_inner_folds(net, parts), *_flap_folds(net, carried))
    shapes = [move_shape(motion, _opened(parts[part], carried)) for part, motion in net.motions.items()]
    tabs = [move_shape(net.motions[flap.carrier], flap.polygon) for flap in carried]
    lines = [fold.ends for fold in folds]
    lines += [move(net.motions[flap.carrier], flap.line) for flap in carried if flap.crease is Crease.NONE]
    outline = _merged([*shapes, *tabs], lines, name)
    return Piece(
        name=name,
        motions=net.motions,
        outline=outline,
        slits=_slits([*shapes, *tabs], outline, lines),
        folds=folds,
        flaps=carried,
        places=tuple(flap for flap in flaps if flap.target in net.motions),
    )


def _opened(part: Part, flaps: tuple[Flap, ...]) -> "BaseGeometry":
    """The part without the openings of its slots."""
    import shapely

    openings = [flap.opening for flap in flaps if flap.carrier == part.id and flap.opening is not None]
    return without(part.polygon, shapely.unary_union(openings)) if openings else part.polygon


def _inner_folds(net: Net, parts: Mapping[str, Part]) -> Iterator[Fold]:
    for joint in net.folds:
        first, second = (parts[name] for name in joint.parts)
        for one, other in zip(contacts(joint, first), contacts(joint, second), strict=True):
            if joint.hinge is not None:
                crease = bend(first.plane.normal, into(second, other), joint.hinge)
                yield Fold(move(net.motions[first.id], one.ends), crease, joint, joint.parts, Face.PRINTED)


def _flap_folds(net: Net, flaps: tuple[Flap, ...]) -> Iterator[Fold]:
    for flap in flaps:
        if flap.crease is not Crease.NONE:
            turned = (flap.face is Face.PRINTED) == flap.glue_on_print
            face = Face.REVERSE if turned else Face.PRINTED
            ends = move(net.motions[flap.carrier], flap.line)
            yield Fold(ends, flap.crease, flap.joint, (flap.carrier, flap.target), face)


def _merged(shapes: list["BaseGeometry"], lines: list[FloatArray], name: str) -> "Polygon":
    """Union of all shapes, welded along `lines`."""
    import shapely

    bridges = [shapely.LineString(line).buffer(BRIDGE, cap_style="flat") for line in lines]
    union = shapely.unary_union([*shapes, *bridges], grid_size=BRIDGE / 20).simplify(BRIDGE)
    if union.geom_type != "Polygon":
        main = max(shapely.get_parts(union), key=lambda shape: shape.area)
        if union.area - main.area > 0.01 or main.geom_type != "Polygon":
            raise LayoutError(
                f"piece {name}: its patches do not meet along their folds; let the hinge axes lie on both outlines"
            )
        union = main
    return shapely.orient_polygons(union)


def _slits(shapes: list["BaseGeometry"], outline: "Polygon", lines: list[FloatArray]) -> tuple[FloatArray, ...]:
    """Boundaries of the shapes that are neither outline nor crease."""
    import shapely

    inner = shapely.unary_union([shape.boundary for shape in shapes], grid_size=BRIDGE / 20)
    edges = [pair for line in shapely.get_parts(inner) for pair in pairwise(shapely.get_coordinates(line))]
    known = shapely.unary_union([outline.boundary, *(shapely.LineString(line) for line in lines)])
    middles = shapely.points([(start + end) / 2 for start, end in edges])
    apart = shapely.distance(middles, known) > 5 * BRIDGE
    cuts = [shapely.LineString(edge) for edge, far in zip(edges, apart, strict=True) if far]
    merged = shapely.line_merge(shapely.unary_union(cuts)) if cuts else shapely.MultiLineString()
    found = [line.simplify(BRIDGE) for line in shapely.get_parts(merged)]
    return tuple(shapely.get_coordinates(line) for line in found if line.length > SHORTEST_SLIT)
