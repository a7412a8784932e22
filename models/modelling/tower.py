"""An iron lattice tower on four curved legs that join. z up."""

from itertools import pairwise

import numpy as np
from PIL import Image

from modelling.atlas import Atlas, Skin, View, painted, plain
from modelling.brush import Brush
from modelling.mesh import FloatArray, Mesh
from modelling.polygon import Point
from modelling.shapes import box, cylinder, loft, rounds

_SCALE = 150  # pixels per unit
_IRON, _LIGHT, _SHADE, _STONE = "#6e4a2c", "#d8b98a", "#8d633d", "#c9bda6"
_JOIN, _TOP = 3.0, 5.5  # heights at which the legs join and the shaft ends
_PLATFORMS = ((1.14, 0.1, 0.16), (2.3, 0.08, 0.13), (_TOP, 0.09, 0.1))  # height, overhang, thickness


def outer(height: float) -> float:
    """Half width of the tower at a height: it falls exponentially, as that of the Eiffel Tower does."""
    return float(1.25 * np.exp(-0.475 * height))


def inner(height: float) -> float:
    """Half width of the gap between the legs at a height; 0 where they have joined."""
    return max(0.0, outer(height) - float(0.5 * np.exp(-0.17 * height)))


def tower() -> tuple[Mesh, Image.Image]:
    """Return the tower and its texture."""
    atlas = Atlas(460)
    view = atlas.view("-y", (-1.4, 1.4), (0, 6.6), _SCALE, _LIGHT, up="z")
    _paint(view.brush)
    iron, stone = atlas.swatch(_SHADE), atlas.swatch(_STONE)
    turned = view.turned("yxz")
    skin = {"-y": view, "+y": view, "-x": turned, "+x": turned, "+z": iron, "-z": iron}
    parts = [*_legs(skin, stone), _shaft(skin), *_arches(skin), *_platforms(skin, iron)]
    return atlas.finished(parts)


def _legs(skin: Skin, stone: View) -> list[Mesh]:
    heights = np.linspace(0.1, _JOIN, 14)
    parts = []
    for sx in (-1, 1):
        for sy in (-1, 1):
            parts.append(painted(loft([_leg_ring(float(h), sx, sy) for h in heights]), skin))
            low, high = np.array([inner(0), inner(0)]) - 0.05, np.array([outer(0), outer(0)]) + 0.05
            corners = np.sort(np.array([low * [sx, sy], high * [sx, sy]]), axis=0)
            parts.append(plain(box((*corners[0], 0), (*corners[1], 0.14)), stone))
    return parts


def _leg_ring(height: float, sx: int, sy: int) -> FloatArray:
    near, far = inner(height), outer(height)
    square = [(near, near), (far, near), (far, far), (near, far)]
    return np.array([(sx * x, sy * y, height) for x, y in square])


def _shaft(skin: Skin) -> Mesh:
    rings = []
    for height in np.linspace(_JOIN, _TOP, 8):
        half = outer(float(height))
        rings.append([(x * half, y * half, height) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    return painted(loft(rings), skin)


def _arches(skin: Skin) -> list[Mesh]:
    """Arches between the legs, one on each side, leaning as the legs do."""
    rings = []
    for angle in np.linspace(-np.pi / 2, np.pi / 2, 17):
        ring = []
        for radius, depth in ((0.62, 0.03), (0.71, 0.03), (0.71, 0.12), (0.62, 0.12)):
            height = 0.33 + radius * float(np.cos(angle))
            ring.append((radius * float(np.sin(angle)), depth - outer(height), height))
        rings.append(ring)
    arch = loft(rings)
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], dtype=np.float64)
    parts = []
    for turns in range(4):
        parts.append(painted(arch @ np.linalg.matrix_power(quarter, turns).T, skin))
    return parts


def _platforms(skin: Skin, iron: View) -> list[Mesh]:
    parts = []
    for height, overhang, thickness in _PLATFORMS:
        half = outer(height) + overhang
        parts.append(
            painted(box((-half, -half, height - thickness / 2), (half, half, height + thickness / 2)), skin)
        )
        rim = half + 0.03
        low = height + thickness / 2
        parts.append(plain(box((-rim, -rim, low), (rim, rim, low + 0.03)), iron))
    parts.append(painted(box((-0.13, -0.13, _TOP), (0.13, 0.13, 5.78)), skin))
    dome = rounds((5.78, 5.86, 5.93, 5.97), (0.12, 0.1, 0.06, 0.02), "z", 12)
    parts.append(plain(dome, iron))
    parts.append(plain(cylinder(0.022, "z", 5.95, 6.5, 8), iron))
    return parts


def _paint(brush: Brush) -> None:
    levels = [0.1]
    while levels[-1] < _TOP:
        levels.append(min(_TOP, levels[-1] + 0.42 * (outer(levels[-1]) - inner(levels[-1])) + 0.08))
    for low, high in pairwise(levels):
        for sign in (-1, 1):
            _paint_panel(brush, low, high, sign)
    for edge in (outer, inner):
        for sign in (-1, 1):
            points: list[Point] = [(sign * edge(float(h)), float(h)) for h in np.linspace(0.0, _TOP, 60)]
            brush.line(points, _IRON, 0.06 if edge is outer else 0.04)
    for angle in np.linspace(-np.pi / 2, np.pi / 2, 33):
        ray = (float(np.sin(angle)), float(np.cos(angle)))
        brush.line([(r * ray[0], 0.33 + r * ray[1]) for r in (0.62, 0.71)], _IRON, 0.02)
    for height, overhang, thickness in _PLATFORMS:
        _paint_platform(brush, height, outer(height) + overhang, thickness)
    brush.rect((-0.13, 0.13), (_TOP, 5.8), _SHADE)
    brush.rect((-0.1, 0.1), (5.62, 5.72), "#33475a")


def _paint_panel(brush: Brush, low: float, high: float, sign: int) -> None:
    """A crossed panel of one leg between two heights."""
    corners = [(sign * edge(h), h) for edge in (inner, outer) for h in (low, high)]
    brush.line([corners[0], corners[3]], _SHADE, 0.028)
    brush.line([corners[1], corners[2]], _SHADE, 0.028)
    brush.line([corners[0], corners[2]], _IRON, 0.032)


def _paint_platform(brush: Brush, height: float, half: float, thickness: float) -> None:
    low, high = height - thickness / 2, height + thickness / 2
    brush.rect((-half, half), (low, high), _SHADE)
    count = max(4, round(half * 24))
    for i in range(count):
        a = -half + (i + 0.5) * 2 * half / count
        brush.rect(
            (a - half / count * 0.6, a + half / count * 0.6),
            (low + thickness * 0.25, high - thickness * 0.25),
            _LIGHT,
        )
