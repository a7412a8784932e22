"""Patches as thin convex prisms, the shapes that MuJoCo collides and draws."""

import numpy as np

from popsim.design import Patch
from popsim.geometry.arrays import FloatArray
from popsim.simulation.mjcf import text
from popsim.simulation.pieces import convex_pieces


def prisms(patch: Patch, scale: float, skin: float) -> list[FloatArray]:
    """Convex pieces of a patch, `skin` to either side of its plane, each of shape (2 k, 3).

    In units of `scale` mm; so is `skin`.
    """
    rise = skin * patch.plane.normal
    return [np.concatenate([piece / scale + rise, piece / scale - rise]) for piece in convex_pieces(patch)]


def mesh_assets(first: int, parts: list[FloatArray]) -> str:
    """Meshes numbered from `first`."""
    return "".join(
        f'<mesh name="{number}" vertex="{text(part)}" inertia="shell"/>'
        for number, part in enumerate(parts, first)
    )


def mesh_geoms(first: int, parts: list[FloatArray], look: str = "") -> str:
    """Geoms that show the meshes numbered from `first`; `look` is added to each."""
    return "".join(f'<geom type="mesh" mesh="{first + k}"{look}/>' for k in range(len(parts)))
