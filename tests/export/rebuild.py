"""Rebuilding the pieces from cut and crease lines alone, as scissors would; shares no code with the writers."""

from collections.abc import Iterator
from itertools import combinations, pairwise

import numpy as np
import shapely
from sheet_readers import Side

from popsim.design import Design, Hinge, Patch

TRUE = 0.05
"""mm; how exact the paper must be."""


def faces(lines: Side) -> list[shapely.Polygon]:
    """What is enclosed by cuts and creases: patches and flaps, no holes."""
    corners = np.concatenate(lines.cut) if lines.cut else np.zeros((0, 2))
    creases = [_snapped(points, corners) for points in (*lines.mountain, *lines.valley)]
    strings = [shapely.LineString(points) for points in (*lines.cut, *creases)]
    noded = shapely.unary_union(strings, grid_size=0.01)
    found = list(shapely.get_parts(shapely.polygonize(shapely.get_parts(noded))))
    rings = [shapely.Polygon(points) for points in lines.cut if np.abs(points[0] - points[-1]).max() < TRUE / 2]
    return [face for face in found if _is_paper(face.representative_point(), rings)]


def _is_paper(spot: shapely.Point, rings: list[shapely.Polygon]) -> bool:
    """Within an outline, not within a hole in it, but again within a piece that lies in the hole, and so on."""
    return sum(ring.contains(spot) for ring in rings) % 2 == 1


def _snapped(crease: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """A crease from corner to corner where they are as near as that, else drawn on a little."""
    along = (crease[-1] - crease[0]) / np.linalg.norm(crease[-1] - crease[0])
    ends = []
    for end, beyond in ((crease[0], -along), (crease[-1], along)):
        off = np.linalg.norm(corners - end, axis=1)
        ends.append(corners[off.argmin()] if len(off) and off.min() < TRUE else end + TRUE * beyond)
    return np.array(ends)


def shape_of(patch: Patch) -> shapely.Polygon:
    """A patch flat, seen from the side from which its outline runs counterclockwise."""
    return patch.plane.polygon(patch.points, patch.hole_points)


def fits_onto(face: shapely.Polygon, patch: shapely.Polygon) -> Iterator[np.ndarray]:
    """Motions (3, 3), without mirroring, that lay `patch` onto `face` to within TRUE."""
    if abs(face.area - patch.area) > TRUE * patch.length:
        return
    here, there = (
        shapely.get_coordinates(shapely.orient_polygons(p).exterior.simplify(0.02)) for p in (patch, face)
    )
    start, end = max(pairwise(here), key=lambda e: np.linalg.norm(e[1] - e[0]))
    length = np.linalg.norm(end - start)
    for one, other in combinations(range(len(there)), 2):
        for a, b in ((there[one], there[other]), (there[other], there[one])):
            if abs(np.linalg.norm(b - a) - length) > TRUE:
                continue
            angle = np.arctan2(*(b - a)[::-1]) - np.arctan2(*(end - start)[::-1])
            turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
            shift = (a + b) / 2 - turn @ (start + end) / 2
            moved = shapely.transform(patch, lambda xy, t=turn, s=shift: xy @ t.T + s)
            if moved.hausdorff_distance(face) < TRUE:
                motion = np.eye(3)
                motion[:2, :2], motion[:2, 2] = turn, shift
                yield motion


def match(found: list[shapely.Polygon], design: Design) -> dict[str, list[tuple[int, np.ndarray]]]:
    """For each patch the faces it is congruent to, with the motions onto them."""
    return {
        patch.id: [(k, motion) for k, face in enumerate(found) for motion in fits_onto(face, shape_of(patch))]
        for patch in design.patches
    }


def bends_away(hinge: Hinge, design: Design) -> bool:
    """Whether a fold is a mountain: the second patch turns away from the printed side of the first."""
    first, second = (design.patch_by_id[name] for name in hinge.patches)
    if hinge.crease is not None:
        return bool(np.array(hinge.crease) @ first.plane.normal > 0)
    beyond = second.points.mean(axis=0) - hinge.points.mean(axis=0)
    return bool(beyond @ first.plane.normal < 0)
