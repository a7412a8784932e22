"""The pop-up as a surface that moves: painted once, posed often."""

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Material, Surface

RED = np.array([0.85, 0.1, 0.1])
"""What marked patches are tinted with."""

SHARE = 0.65
"""How much of the colour of a marked patch is red: its print can still be told."""


class MovingPopup:
    """All patches of a design with their prints.

    Parameters
    ----------
    design:
        The design.
    textures:
        The folder its texture paths are relative to.

    Raises
    ------
    InputError
        A texture is missing or no image.
    """

    def __init__(self, design: Design, textures: Path) -> None:
        from popsim.patches.popup_surface import popup_surface

        self._parts = {
            patch.id: popup_surface(design.model_copy(update={"patches": (patch,)}), textures)
            for patch in design.patches
        }

    def posed(self, poses: FloatArray, marked: Collection[str] = ()) -> Surface:
        """The surface with the patches, in the order of the design, moved by `poses` (p, 4, 4), some in red."""
        parts = [
            (_reddened(part) if name in marked else part).transformed(pose)
            for (name, part), pose in zip(self._parts.items(), poses, strict=True)
        ]
        return Surface.of_parts(parts)


def _reddened(surface: Surface) -> Surface:
    return replace(surface, materials=tuple(_red(material) for material in surface.materials))


def _red(material: Material) -> Material:
    colour, texture = material.colour.copy(), material.texture
    if texture is None:
        colour[:3] = (1 - SHARE) * colour[:3] + SHARE * RED
        return Material(colour)
    texture = texture.copy()
    texture[..., :3] = np.rint((1 - SHARE) * texture[..., :3] + SHARE * 255 * RED)
    return Material(colour, texture)
