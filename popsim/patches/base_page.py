"""What is printed on ground and backdrop: where things stand, or what lies there."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Card
from popsim.geometry.arrays import BoolArray, FloatArray, UInt8Array
from popsim.geometry.plane import Plane
from popsim.mechanisms import Mechanism
from popsim.mechanisms.assemble import page_outline
from popsim.patches.settings import MM_PER_INCH, PatchSettings
from popsim.patches.sight import Grid, colours, look
from popsim.patches.texture import Print, frame_of, png
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

DPI = 150.0
"""Pages are seen from farther away than patches, and hold nothing finer than their lines."""

LINE = 0.4
"""mm; width of outlines."""

INK = 0.62
"""Brightness of outlines."""

GROUND = 0.05
"""Share of the height of the model up to which what is seen from above is ground."""

SHADOW, SOFTNESS = 0.35, 2.5
"""How much a printed shadow takes of the light, and how far its border is spread, mm."""

FLOOR = Plane(np.zeros(3), np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
"""Both pages, open, seen from inside the card."""


def base_prints(
    scene: RayScene, card: Card, mechanisms: Sequence[Mechanism], settings: PatchSettings
) -> dict[str, Print]:
    """Prints of ground and backdrop, by patch id; none where the base stays bare."""
    if settings.base == "none":
        return {}
    found = {}
    for name, sign in ((GROUND_ID, 1), (BACKDROP_ID, -1)):
        page = FLOOR.flat(page_outline(card, sign))
        (left, lower), (right, upper), bleed = page.min(axis=0), page.max(axis=0), settings.bleed
        bounds = (left - bleed, lower - bleed, right + bleed, upper + bleed)
        grid = Grid.over(FLOOR, bounds, max(settings.print_pixel, MM_PER_INCH / DPI))
        image = outlined(grid, mechanisms) if settings.base == "outline" else ground(scene, grid)
        found[name] = Print(png(image), frame_of(grid))
    return found


def footprint(mechanisms: Sequence[Mechanism]) -> "BaseGeometry":
    """The part of the open pages, flat, on which mechanisms stand that are glued to them."""
    from shapely import union_all
    from shapely.geometry import MultiPoint

    pages = {GROUND_ID, BACKDROP_ID}
    standing = [mechanism for mechanism in mechanisms if pages & set(mechanism.pair.patches)]
    corners = [np.concatenate([plate.outline for plate in mechanism.plates()]) for mechanism in standing]
    return union_all([MultiPoint(points[:, :2]).convex_hull for points in corners])


def outlined(grid: Grid, mechanisms: Sequence[Mechanism]) -> UInt8Array:
    """A line around everything that stands on the pages, grey on white, shape (rows, columns, 3)."""
    fine = Grid(grid.plane, grid.low, grid.pixel / 2, (2 * grid.shape[0], 2 * grid.shape[1]))
    line = fine.covered(footprint(mechanisms).boundary.buffer(LINE / 2))
    share = line.reshape(grid.shape[0], 2, grid.shape[1], 2).mean(axis=(1, 3))
    return _grey(1 - (1 - INK) * share)


def ground(scene: RayScene, grid: Grid) -> UInt8Array:
    """What lies on the ground around the model, and the soft shadow of the rest, shape (rows, columns, 3)."""
    low, high = scene.surface.bounds
    sight = look(scene, grid, scene.surface.bounds, -np.inf, np.inf)
    level = -sight.depth
    lies = sight.mask & (level <= max(low[2], 0.0) + GROUND * (high[2] - low[2]))
    image = _grey(1 - SHADOW * _blurred(sight.mask & ~lies, SOFTNESS / grid.pixel))
    colour = colours(scene, sight)
    image[lies] = (image[lies] / 255.0 * colour[lies]).astype(np.uint8)
    return image


def _blurred(mask: BoolArray, pixels: float) -> FloatArray:
    from scipy.ndimage import gaussian_filter

    return np.asarray(gaussian_filter(mask.astype(np.float32), pixels), np.float64)


def _grey(bright: FloatArray) -> UInt8Array:
    """Brightness in 0..1, shape (rows, columns), as an image."""
    return np.repeat(np.rint(255 * bright).astype(np.uint8)[..., None], 3, axis=2)
