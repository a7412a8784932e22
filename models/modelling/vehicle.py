"""What the two trucks share: bodies with wheel arches, wheels, lamps."""

from collections.abc import Sequence

import numpy as np

from modelling.atlas import Skin, View, everywhere, painted, plain
from modelling.brush import Brush, Colour
from modelling.mesh import Mesh, joined, normals
from modelling.polygon import Point
from modelling.shapes import circle, prism, rounds


def body(profile: Sequence[Point], half_width: float, skin: Skin, dark: View, arch_top: float) -> Mesh:
    """Return a body with the side profile (z, y); surfaces across it that stay below `arch_top` are dark."""
    triangles = prism(profile, "x", -half_width, half_width)
    across = np.abs(normals(triangles)[:, 0]) < 0.5
    inside = across & (triangles[:, :, 1].max(axis=1) <= arch_top + 1e-6)
    return joined([painted(triangles[~inside], skin), plain(triangles[inside], dark)])


def wheel(radius: float, width: float, disc: View, rubber: View, lugs: int = 0) -> Mesh:
    """Return a wheel about the x axis from x = 0 outwards to `width`; `lugs` counts the blocks of its tread."""
    skin = {**everywhere(rubber), "+x": disc, "-x": disc}
    edge = width * 0.15
    shoulder = radius - edge * 1.3
    heights, radii = [0, edge, width - edge, width], [shoulder, radius, radius, shoulder]
    if not lugs:
        return painted(rounds(heights, radii, "x", 28), skin)
    tyre = painted(rounds(heights, [r * 0.94 for r in radii], "x", 32), skin)
    tread = prism(_cogs(radius, lugs), "x", width * 0.12, width * 0.88)
    return joined([tyre, plain(tread, rubber)])


def paint_wheel(brush: Brush, radius: float, rim: Colour, hub: Colour, spokes: int) -> None:
    """Paint tyre, rim with round openings, nuts and hub about the origin."""
    for share, colour in ((1.0, "#2a2a2e"), (0.84, "#3a3a40"), (0.8, "#2a2a2e"), (0.62, "#1b1b1f"), (0.59, rim)):
        brush.disc((0, 0), radius * share, colour)
    for a, b in circle(radius * 0.41, spokes):
        brush.disc((a, b), radius * 1.5 / (spokes + 3), "#2a2a2e")
    brush.disc((0, 0), radius * 0.24, hub)
    for a, b in circle(radius * 0.17, 6):
        brush.disc((a, b), radius * 0.025, "#3a3a40")
    brush.disc((0, 0), radius * 0.09, "#3a3a40")


def _cogs(radius: float, count: int) -> list[Point]:
    """Cog wheel outline: blocks as wide as their gaps."""
    outer, inner = circle(radius, 4 * count), circle(radius * 0.93, 4 * count)
    return [(outer if i % 4 < 2 else inner)[i] for i in range(4 * count)]
