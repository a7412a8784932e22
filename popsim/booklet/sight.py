"""What of flat paper in space is seen along parallel rays: exact, by areas in the plane of the picture.

Of two plates the nearer one hides the other where both are; which is nearer changes on the line in which their
planes meet, so each plate is cut by half planes only. Picture coordinates are those of
:class:`popsim.rendering.view.View`: x to the right, y up, depth away from the eye.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from popsim.booklet.cutout import Cutout
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane
from popsim.geometry.rigid import turns_about

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from popsim.rendering.view import View

TOUCHING = 0.02
"""mm of depth; plates nearer to each other than this do not hide each other: they lie on each other or share an
edge."""

GRAIN = 1e-6
"""mm; the grid of overlays that fail without one."""

EDGE_ON = 0.02
"""Cosine between the normal of a plate and the eye below which it is drawn turned to that: never as nothing."""


@dataclass(frozen=True, eq=False)
class Plate:
    """A cutout in space: its plane, in which its flat coordinates are, has its normal to the printed side.

    `shines` says whether those of its edges are wanted that are hidden.
    """

    cutout: Cutout
    plane: Plane
    shines: bool = True


@dataclass(frozen=True, eq=False)
class Seen:
    """A plate in the picture, mm, and what of it is seen.

    Attributes
    ----------
    whole:
        All of it, as if nothing was before it.
    area:
        What is seen of it; may be empty.
    printed:
        Whether its printed side is towards the eye.
    edges, creases:
        Lines of its cutout that are seen.
    hidden:
        Edges that are not, where they are wanted.
    """

    whole: "BaseGeometry"
    area: "BaseGeometry"
    printed: bool
    edges: "BaseGeometry"
    creases: "BaseGeometry"
    hidden: "BaseGeometry"


@dataclass(frozen=True, eq=False)
class Projected:
    """A plate on its way into the picture.

    `motion` (3, 3) brings flat into picture coordinates, and the depth at (x, y) is `depth` @ (x, y, 1).
    """

    motion: FloatArray
    depth: FloatArray
    printed: bool


def project(plate: Plate, view: "View") -> Projected:
    """Project a plate along the rays of `view`; plates seen edge-on are turned by a hair."""
    plane = _facing(plate, view)
    origin, u, v = plane.origin, plane.origin + plane.u, plane.origin + plane.v
    spots = view.to_plane(np.array([origin, u, v]))
    columns = np.stack([spots[1] - spots[0], spots[2] - spots[0], spots[0]], axis=1)
    motion = np.vstack([columns[:2], [0.0, 0.0, 1.0]])
    return Projected(motion, columns[2] @ np.linalg.inv(motion), bool(plane.normal @ view.eye > 0))


def see(plates: Sequence[Plate], view: "View") -> tuple[Seen, ...]:
    """Return what is seen of each plate, in their order; all overlays of one kind at once."""
    import shapely

    if not plates:
        return ()
    projected = [project(plate, view) for plate in plates]
    motions = np.array([one.motion for one in projected])
    cutouts = [plate.cutout for plate in plates]
    whole, edges, creases = (
        _placed([getattr(cutout, name) for cutout in cutouts], motions) for name in ("shape", "edges", "creases")
    )
    before: list[list[BaseGeometry]] = [[] for _ in projected]
    for back, cover in _covers(whole, np.array([one.depth for one in projected])):
        before[back].append(cover)
    covers = np.array([_joined(shape, own) for shape, own in zip(whole, before, strict=True)])
    area = _overlaid(shapely.difference, whole, covers)
    some = ~shapely.is_empty(area)
    left = [np.where(some, lines, shapely.MultiLineString()) for lines in (edges, creases)]
    seen = [_overlaid(shapely.difference, lines, np.where(some, covers, shapely.MultiPolygon())) for lines in left]
    shining = np.array([plate.shines for plate in plates])
    hidden = _overlaid(shapely.intersection, np.where(shining, edges, shapely.MultiLineString()), covers)
    return tuple(
        Seen(whole[k], area[k], one.printed, seen[0][k], seen[1][k], hidden[k]) for k, one in enumerate(projected)
    )


def _joined(shape: "BaseGeometry", covers: list["BaseGeometry"]) -> "BaseGeometry":
    """Some covers of a shape as one; where one alone hides it all, the others do not matter."""
    import shapely

    if len(covers) < 2:
        return covers[0] if covers else shapely.MultiPolygon()
    all_over = np.flatnonzero(shapely.covers(covers, shape))
    return covers[all_over[0]] if len(all_over) else _overlaid(shapely.union_all, covers)


def _overlaid(overlay: Callable[..., Any], *shapes: Any) -> Any:
    """An overlay of shapes; where it fails, taken of what is valid of them, on a grid.

    Where edges all but coincide an earlier overlay may give polygons within polygons, on which later ones fail.
    """
    import shapely

    try:
        return overlay(*shapes)
    except shapely.errors.GEOSException:
        valid = [shapely.make_valid(shape, method="structure", keep_collapsed=False) for shape in shapes]
        return overlay(*valid, grid_size=GRAIN)


def _placed(shapes: list["BaseGeometry"], motions: FloatArray) -> Any:
    """Shapes moved each by its own motion (n, 3, 3), as an array."""
    import shapely

    found = np.array(shapes, dtype=object)
    points, owner = shapely.get_coordinates(found, return_index=True)
    moved = (motions[owner, :2, :2] @ points[:, :, None])[..., 0] + motions[owner, :2, 2]
    return shapely.set_coordinates(found.copy(), moved)


def _covers(shapes: Any, depths: FloatArray) -> Iterator[tuple[int, "BaseGeometry"]]:
    """For each plate that may be hidden its index and an area in which another one is nearer to the eye."""
    import shapely

    bounds = shapely.bounds(shapes)
    back, front = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    low = np.maximum(bounds[back, :2], bounds[front, :2])
    high = np.minimum(bounds[back, 2:], bounds[front, 2:])
    corners = np.stack([low, np.stack([high[:, 0], low[:, 1]], 1), high, np.stack([low[:, 0], high[:, 1]], 1)], 1)
    slope = depths[back] - depths[front]
    nearer = np.einsum("kij,kj->ki", corners, slope[:, :2]) + slope[:, 2:] - TOUCHING
    found = shapes[front]
    some = (nearer > 0).any(axis=1)
    cut = some & (nearer <= 0).any(axis=1)
    found[cut] = _overlaid(shapely.intersection, found[cut], _above(corners[cut], nearer[cut]))
    for k in np.flatnonzero(some):
        yield int(back[k]), found[k]


def _above(corners: FloatArray, values: FloatArray) -> Any:
    """The parts of convex polygons (m, n, 2) where functions, linear with `values` (m, n) at corners, are > 0."""
    import shapely

    after, next_values = np.roll(corners, -1, axis=1), np.roll(values, -1, axis=1)
    crossing = (values > 0) != (next_values > 0)
    fall = np.where(crossing, values - next_values, 1.0)
    points = np.stack([corners, corners + (after - corners) * values[:, :, None] / fall[:, :, None]], axis=2)
    kept = np.stack([values > 0, crossing], axis=2)  # a corner, then where the edge after it crosses 0
    owners = np.broadcast_to(np.arange(len(corners))[:, None, None], kept.shape)
    return shapely.polygons(shapely.linearrings(points[kept], indices=owners[kept]))


def _facing(plate: Plate, view: "View") -> Plane:
    """The plane of a plate, turned by a hair about its middle if it is seen edge-on."""
    plane = plate.plane
    facing = float(plane.normal @ view.eye)
    if abs(facing) >= EDGE_ON:
        return plane
    middle = plate.cutout.shape.centroid
    centre = plane.lift(np.array([middle.x, middle.y]))
    axis = np.cross(plane.normal, view.eye)
    axis /= np.linalg.norm(axis)
    turn = (np.sign(facing) or 1.0) * EDGE_ON - facing
    return plane.moved(turns_about(axis, centre, np.array([turn]))[0])
