"""Divisions of patches that exceed the sheet, for flaps under their seams to join again.

Patches that lie in one plane are divided together: where their seams meet, flaps between them stay whole. Most can
be divided in several ways that are as good by themselves; which is best depends on what else goes onto the sheets.
"""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Design, Hinge, Patch
from popsim.design.rules import TOUCHING
from popsim.geometry.arrays import FloatArray
from popsim.layout.parts import Part, whole
from popsim.layout.settings import LayoutSettings
from popsim.layout.split import Flaps, Hints, cut
from popsim.layout.too_large import Room, fits, too_large

if TYPE_CHECKING:
    from shapely.geometry import Polygon

Division = Mapping[str, tuple["Polygon", ...]]
"""Outlines of the parts of some patches in the patches' flat coordinates, by patch id."""

MOST_PARTS = 16
"""A patch that needs more is refused: nobody glues a poster from handkerchiefs."""

NARROWEST = 10.0
"""mm; parts of less beside the flaps of their seams are none."""

LEANINGS = (1.0, 0.75, 0.5, 0.25, 0.0)
"""Where seams are tried, of the range of their places."""


def plain_divisions(design: Design, room: Room, settings: LayoutSettings) -> tuple[Division, ...]:
    """The plainest divisions of all patches that exceed the sheet, plane by plane.

    Raises
    ------
    LayoutError
        A patch exceeds the sheet and may not be divided, or only into too many parts.
    """
    marks: list[FloatArray] = []
    found = []
    for group in _groups(design, room, settings):
        plain = _divided(group, design, room, settings, marks)
        for patch in group:
            if len(plain[patch.id]) > MOST_PARTS:
                raise _refusal(patch, design, room, settings, f"it would take {len(plain[patch.id])} parts")
        marks += _corners(design, plain, settings.grain_axis(room))
        found.append(plain)
    return tuple(found)


def other_divisions(
    plain: Division, before: Iterable[Division], design: Design, room: Room, settings: LayoutSettings
) -> tuple[Division, ...]:
    """Other divisions of one plane, each once: into as many parts, and then into one more of each patch, or row.

    `before` are the plainest divisions of the planes before.
    """
    group, grain = [design.patch_by_id[name] for name in plain], settings.grain_axis(room)
    marks = [corner for division in before for corner in _corners(design, division, grain)]
    found = {_content(plain): plain}
    for more in (0, 1):
        ways = [_divided(group, design, room, settings, marks, leaning, more) for leaning in LEANINGS]
        most = count_parts(plain) + more * len(group)
        if more:  # patches that are divided both ways get a row of parts more at least
            most = min((count for way in ways if (count := count_parts(way)) >= most), default=most)
        found |= {_content(way): way for way in ways if count_parts(way) <= most and _content(way) not in found}
    return tuple(found.values())[1:]


def count_parts(division: Division) -> int:
    """Into how many parts patches are divided, all together."""
    return sum(map(len, division.values()))


def parts_of(design: Design, divisions: Iterable[Division], grain: int | None = None) -> tuple[Part, ...]:
    """The parts of all patches, in the order of the design; `grain` as of :func:`popsim.layout.parts.whole`."""
    divided = {name: polygons for division in divisions for name, polygons in division.items()}
    parts: list[Part] = []
    for patch in design.patches:
        part = whole(patch, grain)
        if patch.id in divided:
            parts += [Part(f"{part.id}/{k}", patch, part.plane, p) for k, p in enumerate(divided[patch.id], 1)]
        else:
            parts.append(part)
    return tuple(parts)


def hints_of(part: Part, design: Design, marks: Iterable[FloatArray] = ()) -> Hints:
    """What seams of a part heed: hinges of its patch, and corners of parts near its plane, each (3,)."""
    lines = [part.flat(hinge.points) for hinge in design.hinges_by_patch[part.patch.id]]
    return Hints(lines, [part.flat(mark) for mark in marks if abs(float(part.plane.distance(mark))) < TOUCHING])


def _groups(design: Design, room: Room, settings: LayoutSettings) -> list[list[Patch]]:
    """Patches that must be divided, by their planes."""
    groups: list[list[Patch]] = []
    for patch in design.patches:
        part = whole(patch, settings.grain_axis(room))
        with_flaps = _with_flaps(part, design.hinges_by_patch[patch.id], settings)
        if fits(with_flaps, room, 0.0, grain=settings.grain):
            continue
        if not settings.split:
            raise _refusal(patch, design, room, settings, "dividing it is switched off")
        if min(room) < 2 * settings.seam_depth + NARROWEST:
            raise _refusal(patch, design, room, settings, "its parts would have no room for their flaps")
        for group in groups:
            if np.abs(group[0].plane.distance(patch.points)).max() < TOUCHING:
                group.append(patch)
                break
        else:
            groups.append([patch])
    return groups


def _divided(
    group: list[Patch],
    design: Design,
    room: Room,
    settings: LayoutSettings,
    before: list[FloatArray],
    leaning: float | None = None,
    more: int = 0,
) -> dict[str, tuple["Polygon", ...]]:
    """One division of patches in one plane; corners of parts `before` are where seams had best end."""
    division: dict[str, tuple[Polygon, ...]] = {}
    marks = list(before)
    for patch in group:
        part = whole(patch, settings.grain_axis(room))
        whole_flaps = _size(_with_flaps(part, design.hinges_by_patch[patch.id], settings)) - _size(part.polygon)
        flaps = Flaps(
            whole_flaps, 2 * settings.seam_depth
        )  # a part in the middle may carry those of both its seams
        hints = hints_of(part, design, marks)
        polygons = cut(part.polygon, room, flaps, hints, leaning=leaning, more=more, grain=settings.grain)
        division[patch.id] = tuple(polygons)
        marks += _corners(design, {patch.id: division[patch.id]}, settings.grain_axis(room))
    return division


def _size(shape: "Polygon") -> FloatArray:
    """Width and height, (2,)."""
    low_u, low_v, high_u, high_v = shape.bounds
    return np.array([high_u - low_u, high_v - low_v])


def _corners(design: Design, division: Division, grain: int | None) -> list[FloatArray]:
    """Corners of the parts of patches, in the open pose, each (3,)."""
    return [
        whole(design.patch_by_id[name], grain).plane.lift(np.array(corner))
        for name, polygons in division.items()
        for polygon in polygons
        for corner in polygon.exterior.coords[:-1]
    ]


def _content(division: Division) -> tuple[bytes, ...]:
    return tuple(polygon.wkb for polygons in division.values() for polygon in polygons)


def _refusal(patch: Patch, design: Design, room: Room, settings: LayoutSettings, why: str) -> Exception:
    part = whole(patch, settings.grain_axis(room))
    with_flaps = _with_flaps(part, design.hinges_by_patch[patch.id], settings)
    return too_large(patch.id, part.polygon, with_flaps, room, grain=settings.grain, why=why)


def _with_flaps(part: Part, hinges: tuple[Hinge, ...], settings: LayoutSettings) -> "Polygon":
    """Hull of a part and of all flaps that it may have to carry."""
    import shapely

    depths = [settings.seam_depth if hinge.kind == "central" else settings.flap_depth for hinge in hinges]
    strips = [
        shapely.LineString(part.flat(hinge.points)).buffer(depth, cap_style="flat")
        for hinge, depth in zip(hinges, depths, strict=True)
    ]
    return shapely.union_all([part.polygon, *strips]).convex_hull
