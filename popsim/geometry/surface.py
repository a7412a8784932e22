"""A coloured triangle surface: what a model and an open pop-up look like to the renderer.

It is the one type that the mesh door makes, the patches are painted from, and the pictures are drawn from.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.errors import GeometryError
from popsim.geometry.arrays import FloatArray, IntArray, UInt8Array, locked
from popsim.geometry.extent import CHUNK, extent


@dataclass(frozen=True, eq=False)
class Material:
    """How faces look: `colour` times `texture` (times the corner colours of the surface).

    Attributes
    ----------
    colour:
        RGBA, each 0..1, shape (4,).
    texture:
        RGBA image, shape (h, w, 4), or None. Row 0 is the top of the picture; v = 1 there.
    """

    colour: FloatArray
    texture: UInt8Array | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "colour", locked(self.colour, (4,), "material colour"))


@dataclass(frozen=True, eq=False)
class Surface:
    """`m` triangles with their colours.

    Attributes
    ----------
    triangles:
        Corners, shape (m, 3, 3). The frame and the unit are the caller's.
    uv:
        Texture coordinates per corner, shape (m, 3, 2), repeating; zeros where there is no texture.
    material:
        Index into `materials` per triangle, shape (m,).
    materials:
        At least one.
    colours:
        RGBA per corner (vertex or face colours), 0..1, shape (m, 3, 4), or None for white.
    """

    triangles: FloatArray
    uv: FloatArray
    material: IntArray
    materials: tuple[Material, ...]
    colours: FloatArray | None = None

    def __post_init__(self) -> None:
        count = len(self.triangles)
        object.__setattr__(self, "triangles", locked(self.triangles, (count, 3, 3), "triangles"))
        object.__setattr__(self, "uv", locked(self.uv, (count, 3, 2), "uv"))
        material = np.ascontiguousarray(self.material, dtype=np.int64)
        if material.shape != (count,) or not self.materials:
            raise GeometryError(f"a surface of {count} triangles needs {count} material indices and a material")
        if count and not (material.min() >= 0 and material.max() < len(self.materials)):
            raise GeometryError(f"material indices must lie in 0..{len(self.materials) - 1}")
        material.setflags(write=False)
        object.__setattr__(self, "material", material)
        if self.colours is not None:
            object.__setattr__(self, "colours", locked(self.colours, (count, 3, 4), "colours"))

    @classmethod
    def of_parts(cls, parts: Sequence["Surface"]) -> "Surface":
        """Return the surfaces `parts` as one; at least one, and all with corner colours or none."""
        first = np.cumsum([0, *(len(part.materials) for part in parts)])
        colours = [part.colours for part in parts if part.colours is not None]
        if len(colours) not in (0, len(parts)):
            raise GeometryError("surfaces with and without corner colours cannot be one; give all of them colours")
        return cls(
            np.concatenate([part.triangles for part in parts]),
            np.concatenate([part.uv for part in parts]),
            np.concatenate([part.material + start for part, start in zip(parts, first, strict=False)]),
            tuple(material for part in parts for material in part.materials),
            np.concatenate(colours) if colours else None,
        )

    @property
    def textured(self) -> bool:
        """Whether any material carries an image."""
        return any(m.texture is not None for m in self.materials)

    @cached_property
    def bounds(self) -> FloatArray:
        """Lowest and highest corner, shape (2, 3)."""
        return locked(extent(self.triangles.reshape(-1, 3)), (2, 3), "bounds")

    @property
    def normals(self) -> FloatArray:
        """Unit normals of the faces by the right-hand rule, shape (m, 3); zero where a face has no area."""
        return self._faces[0]

    @property
    def areas(self) -> FloatArray:
        """Areas of the faces, shape (m,)."""
        return self._faces[1]

    @cached_property
    def _faces(self) -> tuple[FloatArray, FloatArray]:
        normals, areas = np.empty((len(self.triangles), 3)), np.empty(len(self.triangles))
        for start in range(0, len(areas), CHUNK):
            part = slice(start, start + CHUNK)
            corners = np.ascontiguousarray(self.triangles[part].reshape(-1, 9).T)
            (a, b, c), (d, e, f) = corners[3:6] - corners[:3], corners[6:] - corners[:3]
            across = np.array([b * f - c * e, c * d - a * f, a * e - b * d])
            doubled = np.linalg.norm(across, axis=0)
            normals[part] = np.divide(across, doubled, out=np.zeros_like(across), where=doubled > 0).T
            areas[part] = doubled / 2
        for array in (normals, areas):
            array.setflags(write=False)
        return normals, areas

    def bare(self) -> "Surface":
        """Return the shape alone: no texture, no colours, and nothing transparent."""
        white = Material(np.ones(4))
        return Surface(self.triangles, self.uv, np.zeros_like(self.material), (white,))

    def transformed(self, matrix: FloatArray) -> "Surface":
        """Return the surface moved by the homogeneous `matrix` (4, 4); mirrors swap the corner order."""
        moved = self.triangles @ matrix[:3, :3].T
        moved += matrix[:3, 3]
        moved.setflags(write=False)
        uv, colours = self.uv, self.colours
        if np.linalg.det(matrix[:3, :3]) < 0:
            moved, uv = moved[:, ::-1], uv[:, ::-1]
            colours = None if colours is None else colours[:, ::-1]
        return Surface(moved, uv, self.material, self.materials, colours)
