"""Textures painted as orthographic views, packed on one picture.

A view is painted in model units. Triangles that face its way take their paint from it by projection, so that a
painted window sits exactly where it was placed on the model.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image, ImageDraw

from modelling.brush import SMOOTHING, Brush, Colour
from modelling.mesh import FloatArray, Mesh, joined, normals

_MARGIN = 3  # pixels painted beyond a view, so that filtering never mixes neighbours
_SWATCH = 6  # pixels on a side
_SIDES = ("+x", "-x", "+y", "-y", "+z", "-z")


@dataclass(frozen=True, eq=False)
class View:
    """A rectangle of the atlas with its projection: pixel (from the left, from the top) = affine @ (x, y, z, 1).

    Attributes
    ----------
    affine:
        Shape (2, 4).
    brush:
        Paints the view in model units.
    """

    affine: FloatArray
    brush: Brush

    def pixels(self, points: FloatArray) -> FloatArray:
        """Return the pixels (..., 2) of points (..., 3)."""
        return np.asarray(points @ self.affine[:, :3].T + self.affine[:, 3], dtype=np.float64)

    def turned(self, order: str) -> "View":
        """Return the same picture on other axes: `order` "zyx" puts on z what was on x. Capitals mirror."""
        columns = ["xyz".index(c.lower()) for c in order]
        signs = np.array([-1.0 if c.isupper() else 1.0 for c in order])
        affine = self.affine.copy()
        affine[:, columns] = self.affine[:, :3] * signs
        return replace(self, affine=affine)


Skin = Mapping[str, View]


@dataclass
class _Shelf:
    """A row of the atlas, in pixels: its top, its height, and how much of its width is taken."""

    top: int
    height: int
    used: int


class Atlas:
    """Packs views on one picture of a width in pixels: each on the first shelf that has room for it."""

    def __init__(self, width: int) -> None:
        self._width = width
        self._shelves: list[_Shelf] = []
        self._tiles: list[tuple[tuple[int, int], Brush]] = []

    def view(
        self,
        facing: str,
        across: tuple[float, float],
        upward: tuple[float, float],
        scale: float,
        fill: Colour,
        *,
        up: str = "y",
    ) -> View:
        """Return a new view of the side that faces `facing` ("+x", "-z", ...), filled with one colour.

        Parameters
        ----------
        across, upward:
            What the view covers of its horizontal and its vertical axis, model units.
        scale:
            Pixels per unit.
        up:
            The vertical axis.
        """
        axes = np.eye(3)
        side = "xyz".index(facing[1])
        vertical = "xyz".index(up)
        horizontal = 3 - side - vertical
        outward = axes[side] * (1 if facing[0] == "+" else -1)
        mirrored = float(np.linalg.det(np.stack([axes[horizontal], axes[vertical], outward]))) < 0
        corner, brush = self._tile(across, upward, scale, fill, mirrored)
        x0, y0 = corner[0] + _MARGIN, corner[1] + _MARGIN
        affine = np.zeros((2, 4))
        affine[0, horizontal] = -scale if mirrored else scale
        affine[0, 3] = x0 + scale * (across[1] if mirrored else -across[0])
        affine[1, vertical] = -scale
        affine[1, 3] = y0 + scale * upward[1]
        return View(affine, brush)

    def swatch(self, fill: Colour) -> View:
        """Return a view of a single colour."""
        corner, brush = self._tile((0, _SWATCH), (0, _SWATCH), 1, fill, False)
        affine = np.zeros((2, 4))
        affine[:, 3] = np.array(corner) + _MARGIN + _SWATCH / 2
        return View(affine, brush)

    def finished(self, parts: Sequence[Mesh]) -> tuple[Mesh, Image.Image]:
        """Return the model that `parts`, still painted in pixels, make up, and its RGB texture."""
        height = sum(shelf.height for shelf in self._shelves)
        picture = Image.new("RGB", (self._width, height), "#808080")
        for corner, brush in self._tiles:
            picture.paste(brush.picture(), corner)
        mesh = joined(parts)
        share = np.clip(mesh.uv / [self._width, height], 0, 1)
        return replace(mesh, uv=share * [1, -1] + [0, 1]), picture

    def _tile(
        self,
        across: tuple[float, float],
        upward: tuple[float, float],
        scale: float,
        fill: Colour,
        mirrored: bool,
    ) -> tuple[tuple[int, int], Brush]:
        """Find room for a tile and start its picture."""
        spans = np.array([across[1] - across[0], upward[1] - upward[0]])
        size = np.ceil(spans * scale - 1e-6).astype(int) + 2 * _MARGIN
        position = self._room(int(size[0]), int(size[1]))
        picture = Image.new("RGB", tuple((size * SMOOTHING).tolist()), fill)
        origin = (across[1] if mirrored else across[0], upward[1])
        brush = Brush(picture, ImageDraw.Draw(picture), origin, scale, mirrored, _MARGIN)
        self._tiles.append((position, brush))
        return position, brush

    def _room(self, width: int, height: int) -> tuple[int, int]:
        """Reserve a rectangle of pixels and return its top left corner."""
        for shelf in self._shelves:
            if shelf.used + width <= self._width and height <= shelf.height:
                shelf.used += width
                return shelf.used - width, shelf.top
        top = sum(shelf.height for shelf in self._shelves)
        if width > self._width:
            raise ValueError(f"no room for {width} pixels across an atlas of {self._width}: widen it")
        self._shelves.append(_Shelf(top, height, width))
        return 0, top


def around(front: View) -> Skin:
    """Return the skin that shows a view painted for +z on all four upright sides, mirrored on none; y up."""
    return {"+z": front, "-z": front.turned("Xyz"), "+x": front.turned("Zyx"), "-x": front.turned("zyx")}


def everywhere(view: View) -> Skin:
    """Return the skin that shows one view on every side."""
    return dict.fromkeys(_SIDES, view)


def painted(triangles: FloatArray, skin: Skin) -> Mesh:
    """Return `triangles` with the paint of the view that each faces most, texture coordinates in pixels.

    `skin` names a view for each side. Atlas.finished makes texture coordinates of the pixels.
    """
    normal = normals(triangles).round(6)
    axis = np.argmax(np.abs(normal), axis=1)
    uv = np.zeros((len(triangles), 3, 2))
    for index, side in enumerate(_SIDES):
        facing = (axis == index // 2) & ((normal[np.arange(len(axis)), axis] < 0) == bool(index % 2))
        if facing.any():
            uv[facing] = skin[side].pixels(triangles[facing])
    return Mesh(triangles, uv, np.full(len(triangles), "paint"))


def plain(triangles: FloatArray, colour: View) -> Mesh:
    """Return `triangles` with one view on every side, as a rule a swatch."""
    return painted(triangles, everywhere(colour))
