"""The layers of a model that stands on the card: what its front, back and top views fall into by Eq. 3 (Sec. 4.3).

Each view is cut where depth or normals leave the quadratic course q(p) = f(p0) + f'(p0) (p - p0) +
1/2 f''(p0) (p - p0)^2 of the pixels before them (:mod:`popsim.rendering.segmentation`). What is left are smooth
pieces: grille, bonnet, windscreen and roof of a car. Those of the top view tell at which heights a box-fold may
have tops, and how far each reaches along the fold; those of the front and back views where it may have end pairs,
and from which height to which.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, locked
from popsim.rendering.maps import OrthographicMaps
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.segmentation import Segment, segment
from popsim.rendering.view import View

PIXELS = 160
"""Along the longest side of the model: on a card of 150 mm about a pixel for each mm."""

STEP = 0.01
"""Depth by which a surface may leave its course, as a share of the longest side: on a card of 150 mm, 1.5 mm."""

TURN = 0.25
"""The same for each component of the unit normal: 15 degrees."""

LEAST = 0.001
"""Area of the smallest layer, as a share of the square over the longest side."""

INSET = 1e-6
"""Share of the longest side by which rays start before the box: faces that lie in its sides are seen."""


@dataclass(frozen=True, eq=False)
class Layer:
    """A part of a surface that is seen as one smooth piece.

    Attributes
    ----------
    box:
        Around what is seen of it, rows low and high, in the frame and unit of the surface, shape (2, 3); a
        hundredth of it at either end along the direction to the eye is left out as noise.
    position:
        Median of its points along the direction to the eye.
    area:
        In the view, in units of length squared.
    normal:
        Mean unit normal, shape (3,).
    """

    box: FloatArray
    position: float
    area: float
    normal: FloatArray


@dataclass(frozen=True, eq=False)
class Level:
    """Layers that lie at one place along an axis: what one top or one end pair can stand for.

    Attributes
    ----------
    at:
        Coordinate along the axis: the mean of the positions of its layers, by area.
    box:
        Around all of them, rows low and high, shape (2, 3).
    area:
        Of all of them, in their view.
    layers:
        The largest first.
    """

    at: float
    box: FloatArray
    area: float
    layers: tuple[Layer, ...]


@dataclass(frozen=True, eq=False)
class Relief:
    """The layers of a model in the card frame, the largest first in each view.

    Attributes
    ----------
    front:
        Seen from +x; the position of a layer is its x.
    back:
        Seen from -x; the position of a layer is -x.
    top:
        Seen from +z; the position of a layer is its z.
    """

    front: tuple[Layer, ...]
    back: tuple[Layer, ...]
    top: tuple[Layer, ...]

    @classmethod
    def of(cls, scene: RayScene, bounds: FloatArray, pixels: int = PIXELS) -> "Relief":
        """Look at a model.

        Parameters
        ----------
        scene:
            The model in the card frame, mm.
        bounds:
            What counts of it, rows low and high, shape (2, 3); what lies outside is not seen.
        pixels:
            Along its longest side.
        """
        front, back, top = (
            layers(scene, eye, bounds=bounds, pixels=pixels) for eye in ((1, 0, 0), (-1, 0, 0), (0, 0, 1))
        )
        return cls(front, back, top)

    def tops(self, width: float) -> tuple[Level, ...]:
        """The heights z at which a box-fold may have tops, the largest area first; see :func:`levels`."""
        return levels(self.top, width)

    def ends(self, sign: int, width: float) -> tuple[Level, ...]:
        """The places x at which a box-fold may have front pairs (`sign` 1) or back pairs (-1); as :meth:`tops`."""
        if sign not in (1, -1):
            raise GeometryError(f"a box-fold ends at sign 1, the front, or -1, the back, not at {sign}")
        return levels(self.front if sign > 0 else self.back, width, sign)


def levels(found: Sequence[Layer], width: float, sign: int = 1) -> tuple[Level, ...]:
    """Gather layers of one view whose positions are nearly the same.

    The largest layer takes all that lie within `width` of it, then the largest of the rest does.

    Parameters
    ----------
    found:
        Layers of one view, the largest first.
    width:
        In the unit of the surface.
    sign:
        1 where the eye looks down its axis, -1 where it looks up: `Level.at` is a coordinate, not a position.

    Returns
    -------
    tuple of Level
        The one with the largest area first.
    """
    rest = list(found)
    gathered = []
    while rest:
        near = [layer for layer in rest if abs(layer.position - rest[0].position) <= width]
        rest = [layer for layer in rest if not any(layer is other for other in near)]
        area = sum(layer.area for layer in near)
        at = sum(layer.area * layer.position for layer in near) / area
        boxes = np.array([layer.box for layer in near])
        box = locked(np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]), (2, 3), "box of a level")
        gathered.append(Level(sign * at, box, area, tuple(near)))
    return tuple(sorted(gathered, key=lambda level: -level.area))


def layers(
    scene: RayScene,
    eye: npt.ArrayLike,
    *,
    bounds: FloatArray | None = None,
    pixels: int = PIXELS,
    step: float = STEP,
    turn: float = TURN,
    least: float = LEAST,
) -> tuple[Layer, ...]:
    """Return the layers that are seen from one side, the largest first.

    Parameters
    ----------
    scene:
        The surface.
    eye:
        Direction to the eye, shape (3,).
    bounds:
        What is seen of the surface, rows low and high, shape (2, 3); None for all.
    pixels:
        Along the longest side of the bounds.
    step:
        Depth by which a surface may leave its quadratic course (Eq. 3), as a share of the longest side.
    turn:
        The same for each component of the unit normal.
    least:
        Area of the smallest layer, as a share of the square over the longest side.
    """
    box = scene.surface.bounds if bounds is None else locked(bounds, (2, 3), "bounds")
    longest = float(np.ptp(box, axis=0).max())
    eye = np.asarray(eye, dtype=np.float64) / np.linalg.norm(eye)
    up = np.array([0.0, 0.0, 1.0]) if abs(eye[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    corners = np.stack(np.meshgrid(*box.T), axis=-1).reshape(-1, 3)
    view = View.framing(corners, eye=eye, up=up, pixels_per_unit=pixels / longest)
    reach = view.to_plane(corners)[:, 2]
    start, stop = float(reach.min()) - INSET * longest, float(reach.max())
    found = segment(_maps(scene, view, start, stop), step=step * longest, turn=turn, least_area=least * longest**2)
    return tuple(_layer(each, view) for each in found.segments)


def _maps(scene: RayScene, view: View, start: float, stop: float) -> OrthographicMaps:
    """Depths between two planes and normals, without colours."""
    plane = view.pixel_centres().reshape(-1, 2)
    origins = view.to_space(np.column_stack([plane, np.full(len(plane), start)]))
    hits = scene.hit(origins, -view.eye[None], far=stop - start)
    seen = hits.face >= 0
    normal = np.zeros((len(plane), 3), dtype=np.float32)
    facing = scene.normals[hits.face[seen]]
    normal[seen] = facing * np.where(facing @ view.eye < 0, -1.0, 1.0)[:, None]
    return OrthographicMaps(
        view,
        seen.reshape(view.shape),
        (hits.distance + start).reshape(view.shape),
        normal.reshape(*view.shape, 3),
        hits.face.astype(np.int32).reshape(view.shape),
        np.zeros((*view.shape, 4), dtype=np.uint8),
    )


def _layer(each: Segment, view: View) -> Layer:
    corners = [[*at, depth] for at in (each.low, each.high) for depth in (each.nearest, each.farthest)]
    points = view.to_space(corners)
    box = np.array([points.min(axis=0), points.max(axis=0)])
    return Layer(
        locked(box, (2, 3), "box of a layer"), -each.depth, each.area, locked(each.normal, (3,), "normal")
    )
