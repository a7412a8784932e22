"""The unlit colours of a surface: material colour times texture times corner colours."""

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.surface import Surface
from popsim.rendering.texture import OPAQUE, Colours, Texture

Values = npt.NDArray[np.float32]

TILE_SLACK = 1e-4  # texture coordinates this far outside a tile are rounding, not repetition
SAME_COLOUR = 0.5 / 255  # colours that differ by less look the same
GREY = 0.04  # red, green and blue within this are a grey, which a modeller's program writes by default
PAPER = np.array([0.93, 0.91, 0.87], dtype=np.float32)  # warm light grey, for models without any colour


class Paint:
    """Colours of points on the faces of a surface, given by face and barycentric coordinates.

    Attributes
    ----------
    holed:
        Faces that may have holes (texels or colours of alpha < 0.5), shape (m,).
    has_holes:
        Whether any face may.
    plain:
        Whether the surface has one colour and no texture, so that only light can show its shape.
    """

    def __init__(self, surface: Surface) -> None:
        self._surface = surface
        self._material_colours = np.array([m.colour for m in surface.materials], dtype=np.float32)
        self._textures = [None if m.texture is None else Texture(m.texture) for m in surface.materials]
        self._one_tile: BoolArray = np.ones(len(surface.triangles), dtype=bool)
        self._linear: list[Values] = []
        if surface.textured:
            self._linear.append(self._in_first_tile(surface.uv))
            self._texels_per_unit = self._density()
        if surface.colours is not None:
            self._linear.append(surface.colours.astype(np.float32))
        self.holed = self._holed_faces()
        self.has_holes = bool(self.holed.any())
        self.plain = not surface.textured and self._one_colour()

    def _in_first_tile(self, uv: FloatArray) -> Values:
        """Texture coordinates (m, 3, 2) shifted by whole tiles; tells which faces lie within one."""
        low, high = uv.min(axis=1), uv.max(axis=1)
        tile = np.floor(low + TILE_SLACK)
        self._one_tile = (high <= tile + 1.0 + TILE_SLACK).all(axis=1)
        shifted: Values = (uv - tile[:, None, :]).astype(np.float32)
        return shifted

    def colours(self, face: IntArray, bary: FloatArray, pixel: FloatArray | float) -> Colours:
        """Return unlit RGBA (k, 4) in 0..1.

        Parameters
        ----------
        face:
            Face indices, shape (k,).
        bary:
            Barycentric coordinates, shape (k, 3).
        pixel:
            Side of a pixel at the points, in units of length; 0 takes texels as they are.
        """
        return self.at(face, self.places(face, bary), pixel)

    def places(self, face: IntArray, bary: FloatArray) -> Values:
        """Return what colours depend on, which is linear on each face, shape (k, c); none where they are constant.

        Texture coordinates where there are textures, then corner colours where there are any.
        """
        weights = bary.astype(np.float32)
        found = [np.einsum("kc,kcd->kd", weights, values[face]) for values in self._linear]
        return np.concatenate([np.zeros((len(face), 0), dtype=np.float32), *found], axis=1)

    def at(self, face: IntArray, places: Values, pixel: FloatArray | float) -> Colours:
        """Return unlit RGBA (k, 4) in 0..1 at :meth:`places` on faces; other parameters as of :meth:`colours`."""
        colours = places[:, -4:] if self._surface.colours is not None else np.float32(1)
        if len(self._textures) == 1:
            alone: Colours = self._textured(0, face, places, pixel) * (self._material_colours[0] * colours)
            return alone
        material = self._surface.material[face]
        found: Colours = self._material_colours[material] * colours
        for index in np.flatnonzero(np.bincount(material)).tolist():
            if self._textures[index] is not None:
                at = np.flatnonzero(material == index)
                some = pixel if np.ndim(pixel) == 0 else np.asarray(pixel)[at]
                found[at] *= self._textured(index, face[at], places[at], some)
        return found

    def _textured(self, index: int, face: IntArray, places: Values, pixel: FloatArray | float) -> Colours:
        """Colours (k, 4) of the texture of one material; white where it has none."""
        texture = self._textures[index]
        if texture is None:
            return np.ones((len(face), 4), dtype=np.float32)
        spans = self._texels_per_unit[face] * np.asarray(pixel, dtype=np.float32)
        return texture.sample(places[:, :2], self._one_tile[face], spans)

    def solid(self, face: IntArray, bary: FloatArray) -> BoolArray:
        """Return where the surface is no hole, shape (k,)."""
        result = ~self.holed[face]
        doubtful = np.flatnonzero(~result)
        if len(doubtful):
            alpha = self.colours(face[doubtful], bary[doubtful], 0.0)[:, 3]
            result[doubtful] = alpha >= OPAQUE
        return result

    def paper(self, colours: Colours) -> Colours:
        """Return `colours` (k, 4), with greys of a plain surface replaced by warm light paper."""
        if not self.plain or not len(colours) or np.ptp(colours[0, :3]) > GREY:
            return colours
        return np.concatenate([np.broadcast_to(PAPER, (len(colours), 3)), colours[:, 3:]], axis=1)

    def _holed_faces(self) -> BoolArray:
        faint = self._material_colours[:, 3] < 1
        holed: BoolArray = faint[self._surface.material]
        if self._surface.colours is not None:
            holed |= (self._surface.colours[:, :, 3] < 1).any(axis=1)
        for index, texture in enumerate(self._textures):
            if texture is not None and texture.has_holes:
                at = np.flatnonzero(self._surface.material == index)
                uv = self._linear[0][at]
                within = texture.holed_within(uv.min(axis=1), uv.max(axis=1))
                holed[at] |= within | ~self._one_tile[at]
        return holed

    def _density(self) -> Values:
        """Return texels per unit of length of each face; 0 where there is no texture."""
        texels = np.array([0 if t is None else t.texels for t in self._textures])
        edges = self._surface.triangles[:, 1:] - self._surface.triangles[:, :1]
        area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
        uv = self._linear[0][:, 1:] - self._linear[0][:, :1]
        uv_area = np.abs(uv[:, 0, 0] * uv[:, 1, 1] - uv[:, 0, 1] * uv[:, 1, 0])
        square = uv_area * texels[self._surface.material]
        density = np.sqrt(np.divide(square, area, out=np.zeros_like(area), where=area > 0))
        return np.asarray(density, dtype=np.float32)

    def _one_colour(self) -> bool:
        used = self._material_colours[np.unique(self._surface.material), :3]
        same = bool(np.ptp(used, axis=0).max(initial=0.0) < SAME_COLOUR)
        corners = self._surface.colours
        return same and (corners is None or bool(np.ptp(corners[..., :3], axis=(0, 1)).max() < SAME_COLOUR))
