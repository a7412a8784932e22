"""Rebuilding the pieces from cut and crease lines alone, as scissors would; shares no code with the writers."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np
import shapely

from popsim.design import Design, Hinge, Patch

TRUE = 0.05
"""mm; how exact the paper must be."""


@dataclass(frozen=True)
class Lines:
    """Lines read from a file, by layer; each an array (n, 2), mm, y up, closed ones with the first point again."""

    cut: list[np.ndarray]
    mountain: list[np.ndarray]
    valley: list[np.ndarray]


def faces(lines: Lines) -> list[shapely.Polygon]:
    """What is enclosed by cuts and creases: patches and flaps."""
    strings = [shapely.LineString(points) for points in (*lines.cut, *lines.mountain, *lines.valley)]
    noded = shapely.unary_union(strings, grid_size=0.01)
    return list(shapely.get_parts(shapely.polygonize(shapely.get_parts(noded))))


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
