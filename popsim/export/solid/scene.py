"""What the writers of solids get: the patches as triangles, and their motion."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Leaf:
    """One patch as a sheet of paper with a printed and a bare side.

    Attributes
    ----------
    name:
        Id of the patch.
    corners:
        Triangles in the open pose, counterclockwise seen from the printed side, mm, shape (n, 3, 3).
    uv:
        Texture coordinates of the corners, v up, shape (n, 3, 2).
    texture:
        Path of the picture on the printed side, relative to the folder of the textures, or None.
    front, back:
        RGB of the two sides, 0..1, shape (3,); the picture is multiplied by that of its side.
    """

    name: str
    corners: FloatArray
    uv: FloatArray
    texture: str | None
    front: FloatArray
    back: FloatArray


@dataclass(frozen=True, eq=False)
class Scene:
    """A design in motion.

    Attributes
    ----------
    leaves:
        All patches, in the order of the design.
    degrees:
        Some fold angles, shape (n,).
    poses:
        Motion of each patch from the open pose at each of them, shape (n, p, 4, 4).
    textures:
        The folder that textures are relative to.
    """

    leaves: tuple[Leaf, ...]
    degrees: FloatArray
    poses: FloatArray
    textures: Path


def leaves_of(design: Design, textures: Path) -> tuple[Leaf, ...]:
    """All patches of a design as leaves.

    Raises
    ------
    InputError
        A texture is missing or no image.
    """
    from popsim.patches.popup_surface import popup_surface

    found = []
    for patch in design.patches:
        surface = popup_surface(design.model_copy(update={"patches": (patch,)}), textures)
        half = len(surface.triangles) // 2  # the printed side, then the same triangles seen from behind
        front, back = (surface.materials[surface.material[k]] for k in (0, half))
        picture = patch.texture if front.texture is not None else None
        found.append(
            Leaf(
                patch.id,
                surface.triangles[:half],
                surface.uv[:half],
                picture,
                front.colour[:3],
                back.colour[:3],
            )
        )
    return tuple(found)


def placed(scene: Scene, leaf: int) -> FloatArray:
    """Triangles of a leaf at the first fold angle, shape (n, 3, 3)."""
    from popsim.geometry.rigid import transform

    corners = scene.leaves[leaf].corners
    return np.asarray(transform(scene.poses[0, leaf], corners.reshape(-1, 3)).reshape(corners.shape))
