"""Orthographic maps of a surface: what the patches are cut and painted from (Sec. 4.3)."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from popsim.errors import InputError
from popsim.geometry.arrays import BoolArray, FloatArray, UInt8Array
from popsim.geometry.surface import Surface
from popsim.rendering.edges import feature_edges
from popsim.rendering.light import LINE, Light, facing
from popsim.rendering.parallel import map_chunks
from popsim.rendering.ray_scene import Hits, RayScene
from popsim.rendering.texture import Colours, eight_bit
from popsim.rendering.view import View

Shading = Literal["auto", "flat", "shaded"]
SHADINGS: tuple[Shading, ...] = ("auto", "flat", "shaded")

LINES_PER_SIDE = 500  # the longer side of a shaded image holds this many feature lines side by side


@dataclass(frozen=True, eq=False)
class OrthographicMaps:
    """What parallel rays see through the pixels of a view. All arrays are read-only.

    Attributes
    ----------
    view:
        Where the pixels lie.
    mask:
        Where a surface is seen, shape (h, w).
    depth:
        Distance from the plane of the view along -eye, shape (h, w), double precision; +inf where empty.
    normal:
        Unit normal of the face in the frame of the surface, turned to the eye, shape (h, w, 3), float32;
        zero where empty.
    face:
        Index of the face, shape (h, w), int32; -1 where empty.
    colour:
        RGBA, shape (h, w, 4); alpha is 255 where a surface is seen (paper is opaque) and 0 where empty.
    """

    view: View
    mask: BoolArray
    depth: FloatArray
    normal: npt.NDArray[np.float32]
    face: npt.NDArray[np.int32]
    colour: UInt8Array

    def __post_init__(self) -> None:
        for array in (self.mask, self.depth, self.normal, self.face, self.colour):
            array.setflags(write=False)


def render_maps(
    scene: RayScene | Surface,
    view: View,
    *,
    near: float | None = None,
    far: float | None = None,
    shading: Shading = "auto",
    through_holes: bool = True,
) -> OrthographicMaps:
    """Return the orthographic maps of `scene` in `view`.

    Parameters
    ----------
    scene:
        A surface, or the scene prepared from it (cheaper for many views).
    view:
        The image plane, in the frame of the surface.
    near, far:
        Only surfaces whose depth lies between these are seen, those in the two planes included (give or
        take the tolerance of the scene); None for no limit.
    shading:
        "flat" keeps the colours as they are; "shaded" adds soft light and feature lines; "auto" shades
        only what has one colour and no texture, since nothing else would show its shape.
    through_holes:
        Rays pass through texels and colours of alpha < 0.5 (at most 64 of them); otherwise these are seen
        like any other.

    Raises
    ------
    InputError
        The shading is unknown, or near lies behind far.
    """
    if shading not in SHADINGS:
        raise InputError(f"shading {shading!r} is unknown; choose one of {', '.join(SHADINGS)}")
    if near is not None and far is not None and near > far:
        raise InputError(f"near {near} lies behind far {far}; swap them")
    scene = scene if isinstance(scene, RayScene) else RayScene(scene)
    depths = view.to_plane(scene.surface.triangles.reshape(-1, 3))[:, 2]
    start = float(depths.min()) if near is None else near
    stop = float(depths.max()) if far is None else far
    plane = view.pixel_centres().reshape(-1, 2)
    origins = view.to_space(np.column_stack([plane, np.full(len(plane), start)]))
    hits = scene.hit(origins, -view.eye[None], far=stop - start, through_holes=through_holes, bary=True)
    image = _Image(scene, view, origins, hits)
    colours = image.flat_colours()
    if shading == "shaded" or (shading == "auto" and scene.paint.plain):
        colours = image.shaded(colours)
    return OrthographicMaps(
        view,
        image.seen.reshape(view.shape),
        (hits.distance + start).reshape(view.shape),
        image.normals.reshape(*view.shape, 3),
        hits.face.astype(np.int32).reshape(view.shape),
        image.painted(colours),
    )


class _Image:
    """The pixels of a view, one after another, with what their rays have hit."""

    def __init__(self, scene: RayScene, view: View, origins: FloatArray, hits: Hits) -> None:
        self.scene, self.view, self.origins, self.hits = scene, view, origins, hits
        self.seen: BoolArray = hits.face >= 0
        self.face = hits.face[self.seen]
        self.normals = np.zeros((len(origins), 3), dtype=np.float32)
        self.normals[self.seen] = facing(scene.normals.astype(np.float32)[self.face], -view.eye)

    def flat_colours(self) -> Colours:
        """Return the unlit colours of the pixels that see something, shape (k, 4)."""
        bary, paint, pixel = self.hits.bary[self.seen], self.scene.paint, self.view.pixel
        parts = map_chunks(lambda at: paint.colours(self.face[at], bary[at], pixel), len(self.face))
        return np.concatenate(parts)

    def shaded(self, colours: Colours) -> Colours:
        """Return `colours` (k, 4) with soft light and feature lines."""
        view = self.view
        normals = self.scene.shading_normals(self.face, self.hits.bary[self.seen], -view.eye[None])
        light = Light.of_view(view.right, view.up, view.eye, view.up)
        colours = self.scene.paint.paper(colours)
        return np.concatenate(
            [colours[:, :3] * light.shade(normals) * self._line_factor(normals), colours[:, 3:]], axis=1
        )

    def _line_factor(self, normals: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        shape = self.view.shape
        points = np.zeros((len(self.origins), 3), dtype=np.float32)
        distance = self.hits.distance[self.seen, None]
        spread = np.zeros_like(points)
        spread[self.seen] = normals
        points[self.seen] = self.origins[self.seen] - distance * self.view.eye - self.view.origin
        lines = feature_edges(
            self.seen.reshape(shape),
            spread.reshape(*shape, 3),
            points.reshape(*shape, 3),
            self.view.pixel,
            max(1, round(max(shape) / LINES_PER_SIDE)),
        )
        return np.where(lines.ravel()[self.seen], np.float32(LINE), np.float32(1))[:, None]

    def painted(self, colours: Colours) -> UInt8Array:
        """Return the image (h, w, 4) with these colours (k, 4) of the pixels that see something."""
        image = np.zeros((len(self.origins), 4), dtype=np.uint8)
        image[self.seen, :3] = eight_bit(colours[:, :3])
        image[self.seen, 3] = 255
        return image.reshape(*self.view.shape, 4)
