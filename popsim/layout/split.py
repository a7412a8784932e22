"""Dividing patches that exceed the sheet, along straight lines, for a flap under the seam to join again."""

from math import ceil, inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.design import Design, Hinge
from popsim.design.rules import TOUCHING
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common
from popsim.layout.errors import LayoutError
from popsim.layout.paper import Paper
from popsim.layout.parts import Part, whole
from popsim.layout.settings import LayoutSettings

if TYPE_CHECKING:
    from shapely.geometry import Polygon

MOST_PARTS = 16
"""A patch that needs more is refused: nobody glues a poster from handkerchiefs."""

NARROWEST = 10.0
"""mm; parts of less beside the flaps of their seams are none."""

CANDIDATES = 25
"""Places tried for each seam."""

ALIGNED = 500.0
"""mm of seam that it is worth to divide a patch where its neighbour is divided: flaps between them stay whole."""

CROSSING = 20.0
"""mm of seam that crossing one hinge is worth."""

UNEVEN = 0.2
"""mm of seam that it is worth to make the first part larger by 1 mm: halves of sheets leave no room for others."""

NO_STRIP = 30.0
"""mm; what is left beside a large part is no narrower."""


class Hints(NamedTuple):
    """What seams heed, flat: hinge lines (2, 2) that they avoid, points (2,) where neighbours are divided."""

    lines: list[FloatArray]
    wished: list[FloatArray]


def divide(design: Design, paper: Paper, settings: LayoutSettings) -> tuple[Part, ...]:
    """Return the parts of all patches, in the order of the design.

    Raises
    ------
    LayoutError
        A patch exceeds the sheet and may not be divided, or only into too many parts.
    """
    parts: list[Part] = []
    marks: list[FloatArray] = []
    for patch in design.patches:
        part = whole(patch)
        hinges = design.hinges_by_patch[patch.id]
        with_flaps = _with_flaps(part, hinges, settings)
        if fits(with_flaps, settings.area(paper), 0.0):
            parts.append(part)
            continue
        lines = [part.flat(hinge.points) for hinge in hinges]
        wished = [part.flat(mark) for mark in marks if abs(float(part.plane.distance(mark))) < TOUCHING]
        polygons = _divided(part, with_flaps, paper, settings, Hints(lines, wished))
        parts += [Part(f"{part.id}/{k}", patch, part.plane, p) for k, p in enumerate(polygons, 1)]
        marks += [part.plane.lift(np.array(corner)) for p in polygons for corner in p.exterior.coords[:-1]]
    return tuple(parts)


def _divided(
    part: Part, with_flaps: "Polygon", paper: Paper, settings: LayoutSettings, hints: Hints
) -> list["Polygon"]:
    """The outlines of the parts; LayoutError where it may not be divided, or only into too many."""
    room = settings.area(paper)
    allowance = 2 * settings.seam_depth  # a part in the middle may carry the flaps of both its seams
    if not settings.split:
        raise _too_large(part, with_flaps, paper, settings, "dividing it is switched off")
    if min(room) < allowance + NARROWEST:
        raise _too_large(part, with_flaps, paper, settings, "its parts would have no room for their flaps")
    polygons = _cut(part.polygon, room, allowance, hints)
    if len(polygons) > MOST_PARTS:
        raise _too_large(part, with_flaps, paper, settings, f"it would take {len(polygons)} parts")
    return polygons


def fits(polygon: "Polygon", room: tuple[float, float], allowance: float) -> bool:
    """Whether `polygon` and `allowance` mm for flaps go into `room`, upright, turned by 90 degrees or aslant."""
    low_u, low_v, high_u, high_v = polygon.bounds
    sizes = [(high_u - low_u, high_v - low_v), aslant(polygon)]
    return any(
        max(size) + allowance <= max(room) and min(size) + allowance <= min(room) and min(size) > 0
        for size in sizes
    )


def _with_flaps(part: Part, hinges: tuple[Hinge, ...], settings: LayoutSettings) -> "Polygon":
    """Hull of a part and of all flaps that it may have to carry."""
    import shapely

    depths = [settings.seam_depth if hinge.kind == "central" else settings.flap_depth for hinge in hinges]
    strips = [
        shapely.LineString(part.flat(hinge.points)).buffer(depth, cap_style="flat")
        for hinge, depth in zip(hinges, depths, strict=True)
    ]
    return shapely.union_all([part.polygon, *strips]).convex_hull


def aslant(polygon: "Polygon") -> tuple[float, float]:
    """Sides of the smallest rectangle around `polygon`, at any angle."""
    corners = np.array(polygon.minimum_rotated_rectangle.exterior.coords)
    return float(np.linalg.norm(corners[1] - corners[0])), float(np.linalg.norm(corners[2] - corners[1]))


def _too_large(part: Part, with_flaps: "Polygon", paper: Paper, settings: LayoutSettings, why: str) -> LayoutError:
    size, whole_size = (np.array(shape.bounds[2:]) - shape.bounds[:2] for shape in (part.polygon, with_flaps))
    room = np.array(settings.area(paper))
    fitting = max(float(((side - (whole_size - size)) / size).min()) for side in (room, room[::-1]))
    scale = np.floor(1000 * fitting) / 1000
    return LayoutError(
        f"{part.patch.id} measures {min(size):.1f} x {max(size):.1f} mm, more than {paper.name} holds within its "
        f"margins, and {why}; scale the design by {scale:.3f} or less, or use larger paper"
    )


def _cut(polygon: "Polygon", room: tuple[float, float], allowance: float, hints: Hints) -> list["Polygon"]:
    """Divide until every part fits; seams run along the flat axes."""
    if fits(polygon, room, allowance):
        return [polygon]
    low = np.array(polygon.bounds[:2])
    size = np.array(polygon.bounds[2:]) - low
    limits = min(
        (np.array(side) - allowance for side in (room, room[::-1])),
        key=lambda limit: ceil(size[0] / limit[0]) * ceil(size[1] / limit[1]),
    )
    counts = np.ceil(size / limits)
    axis = int(counts[1] > counts[0])
    rest = (counts[axis] - 1) * limits[axis]
    least = low[axis] + max(size[axis] - rest, 0)
    most = max(least, low[axis] + min(limits[axis], max(size[axis] - NO_STRIP, size[axis] / 2)))
    wished = [float(spot[axis]) for spot in hints.wished if least < spot[axis] < most]
    places = [*np.linspace(least, most, CANDIDATES), *wished]

    def cost(place: float) -> tuple[float, float]:
        bonus = ALIGNED if min((abs(place - spot) for spot in wished), default=1.0) < TOUCHING else 0.0
        return _cost(polygon, axis, place, hints.lines) + UNEVEN * (most - place) - bonus, place

    halves = _halves(polygon, axis, float(min(places, key=cost)))
    return [piece for half in halves for piece in _cut(half, room, allowance, hints)]


def _cost(polygon: "Polygon", axis: int, place: float, lines: list[FloatArray]) -> float:
    """Length of the seam at `place`, and more for each hinge that it crosses."""
    from shapely.geometry import LineString

    ends = np.full((2, 2), place)
    ends[:, 1 - axis] = polygon.bounds[1 - axis], polygon.bounds[3 - axis]
    crossed = sum((line[0, axis] - place) * (line[1, axis] - place) < 0 for line in lines)
    return float(polygon.intersection(LineString(ends)).length + CROSSING * crossed)


def _halves(polygon: "Polygon", axis: int, place: float) -> list["Polygon"]:
    import shapely
    from shapely.geometry import Polygon, box

    bounds = list(polygon.bounds)
    pieces = []
    for end in (axis, 2 + axis):
        window = [bounds[0] - 1, bounds[1] - 1, bounds[2] + 1, bounds[3] + 1]
        window[2 + axis if end == axis else axis] = place
        found = shapely.get_parts(common(polygon, box(*window)))
        pieces += [piece for piece in found if isinstance(piece, Polygon) and piece.area > 0]
    if len(pieces) < 2:  # a place at the rim cuts nothing off: halve instead of going on for ever
        return _halves(polygon, axis, (bounds[axis] + bounds[2 + axis]) / 2) if -inf < place < inf else pieces
    return [shapely.orient_polygons(piece) for piece in pieces]
