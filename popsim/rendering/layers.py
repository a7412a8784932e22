"""The layers that are seen of a surface from one side: what a view falls into by Eq. 3, as boxes (Sec. 4.3)."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray
from popsim.rendering.maps import OrthographicMaps
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.segmentation import Segment, segment
from popsim.rendering.view import View


@dataclass(frozen=True, eq=False)
class Layer:
    """A part of a surface that is seen as one smooth piece.

    Attributes
    ----------
    box:
        Around what is seen of it, rows low and high, in the frame and unit of the surface, shape (2, 3); a
        hundredth of it at either end along the direction is left out as noise.
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


def layers(
    scene: RayScene,
    eye: npt.ArrayLike,
    *,
    pixels: int = 512,
    step: float = 0.01,
    turn: float = 0.25,
    least: float = 0.002,
) -> tuple[Layer, ...]:
    """Return the layers that are seen from one side, the largest first.

    Parameters
    ----------
    scene:
        The surface.
    eye:
        Direction to the eye, shape (3,).
    pixels:
        Along the longer side of the view.
    step:
        Depth by which a surface may leave its quadratic course, as a share of the longer side of the view.
    turn:
        The same for each component of the unit normal.
    least:
        Area of the smallest layer, as a share of the square over the longer side.
    """
    eye = np.asarray(eye, dtype=np.float64) / np.linalg.norm(eye)
    up = np.array([0.0, 0.0, 1.0]) if abs(eye[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    corners = scene.surface.triangles.reshape(-1, 3)
    longer = float(View.framing(corners, eye=eye, up=up, pixels_per_unit=1.0).size.max())
    view = View.framing(corners, eye=eye, up=up, pixels_per_unit=pixels / longer)
    found = segment(_depths(scene, view), step=step * longer, turn=turn, least_area=least * longer**2)
    return tuple(_layer(each, view) for each in found.segments)


def _depths(scene: RayScene, view: View) -> OrthographicMaps:
    """Maps without colours."""
    plane = view.pixel_centres().reshape(-1, 2)
    start = float(view.to_plane(scene.surface.triangles.reshape(-1, 3))[:, 2].min())
    origins = view.to_space(np.column_stack([plane, np.full(len(plane), start)]))
    hits = scene.hit(origins, -view.eye[None])
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
    return Layer(box, -each.depth, each.area, each.normal)
