"""A stepped grand hotel: wide base, two setbacks, twin towers. y up, its front faces +z."""

import numpy as np
from PIL import Image

from modelling.atlas import Atlas, Skin, View, around, everywhere, painted, plain
from modelling.brush import Brush
from modelling.facade import Span
from modelling.mesh import Mesh, both_sides, joined
from modelling.shapes import box, cylinder, rounds

_SCALE = 125  # pixels per unit
_STONE, _PIER, _TRIM, _GLASS, _LIT = "#d8c09a", "#e6d3b1", "#f3e7cf", "#3a4c5e", "#f7d774"
_ROOF, _COPPER, _DARK_COPPER, _GOLD, _SPANDREL = "#8b8378", "#5fa08a", "#43806c", "#d9a93c", "#b59a72"

_TIERS = (  # half width, half depth, bottom, top
    (2.4, 1.5, 0.0, 2.0),
    (1.9, 1.15, 2.0, 3.3),
    (1.55, 0.85, 3.3, 4.6),
)
_TOWER_X, _TOWER, _TOWER_TOP = 0.95, 0.5, 6.3


def hotel() -> tuple[Mesh, Image.Image]:
    """Return the hotel and its texture."""
    atlas = Atlas(1024)
    front = atlas.view("+z", (-2.4, 2.4), (0, 6.7), _SCALE, _STONE)
    side = atlas.view("+x", (-1.5, 1.5), (0, 6.7), _SCALE, _STONE)
    _paint(front.brush, 0, (-_TOWER_X, _TOWER_X))
    _paint(side.brush, 1, (0.0,))
    _paint_entrance(front.brush)
    colours = {c: atlas.swatch(c) for c in (_ROOF, _TRIM, _COPPER, _GOLD, _DARK_COPPER)}
    walls = {**everywhere(colours[_ROOF]), "+z": front, "-z": front, "+x": side, "-x": side}
    return atlas.finished([*_tiers(walls, colours), both_sides(_tower(walls, colours)), *_porch(atlas, colours)])


def _tiers(walls: Skin, colours: dict[str, View]) -> list[Mesh]:
    parts = []
    for half, depth, low, high in _TIERS:
        parts.append(painted(box((-half, low, -depth), (half, high, depth)), walls))
        for sign in (-1, 1):  # parapets
            near, far = sorted((sign * depth, sign * (depth - 0.06)))
            parts.append(plain(box((-half, high, near), (half, high + 0.08, far)), colours[_TRIM]))
            near, far = sorted((sign * half, sign * (half - 0.06)))
            parts.append(plain(box((near, high, -depth), (far, high + 0.08, depth)), colours[_TRIM]))
    return parts


def _tower(walls: Skin, colours: dict[str, View]) -> Mesh:
    """Right-hand tower with its copper crown."""
    x, half = _TOWER_X, _TOWER
    copper, gold = everywhere(colours[_COPPER]), everywhere(colours[_GOLD])
    dome = rounds((6.68, 6.8, 6.98, 7.12, 7.2), (0.36, 0.36, 0.28, 0.16, 0.05), "y", 16)
    parts = [
        painted(box((x - half, 4.6, -half), (x + half, _TOWER_TOP, half)), walls),
        painted(box((x - half - 0.04, _TOWER_TOP, -half - 0.04), (x + half + 0.04, 6.38, half + 0.04)), copper),
        painted(box((x - 0.4, 6.38, -0.4), (x + 0.4, 6.68, 0.4)), walls),
        painted(dome, copper).moved(x, 0, 0),
        painted(cylinder(0.025, "y", 7.18, 7.5, 8), gold).moved(x, 0, 0),
        painted(rounds((7.2, 7.25, 7.3), (0.02, 0.06, 0.02), "y", 10), gold).moved(x, 0, 0),
    ]
    for dx in (-0.44, 0.44):
        for z in (-0.44, 0.44):
            parts.append(painted(rounds((6.38, 6.5, 6.62), (0.07, 0.07, 0.0), "y", 8), gold).moved(x + dx, 0, z))
    return joined(parts)


def _porch(atlas: Atlas, colours: dict[str, View]) -> list[Mesh]:
    """Name boards on both fronts, canopy over the entrance."""
    gold = colours[_GOLD]
    sign = atlas.view("+z", (-0.56, 0.56), (0.66, 0.92), _SCALE * 1.5, "#2f3d4a")
    sign.brush.text((0, 0.79), "GRAND HOTEL", 0.105, _GOLD)
    board = {**around(sign), "+x": gold, "-x": gold, "+y": gold, "-y": gold}
    parts = [
        plain(box((-0.62, 0.5, 1.5), (0.62, 0.58, 1.8)), colours[_GOLD]),
        painted(box((-0.56, 0.66, 1.5), (0.56, 0.92, 1.54)), board),
        painted(box((-0.56, 0.66, -1.54), (0.56, 0.92, -1.5)), board),
    ]
    for x in (-0.56, 0.56):
        post = plain(cylinder(0.025, "y", 0, 0.5, 8), colours[_GOLD])
        parts.append(post.moved(x, 0, 1.76))
    return parts


def _paint(brush: Brush, side: int, towers: tuple[float, ...]) -> None:
    """Paint tiers and towers as they are seen from the front (side 0) or from the right (side 1)."""
    for index, tier in enumerate(_TIERS):
        half, low, high = tier[side], tier[2], tier[3]
        ground = 0.62 if index == 0 else 0.0
        _paint_block(brush, (-half, half), (low + ground, high))
    for middle in towers:
        _paint_block(brush, (middle - _TOWER, middle + _TOWER), (4.6, _TOWER_TOP))
        for i in range(5):
            a = middle - 0.3 + 0.15 * i
            brush.rect((a - 0.04, a + 0.04), (6.42, 6.62), _DARK_COPPER)
    half = _TIERS[0][side]
    brush.rect((-half, half), (0, 0.62), _TRIM)
    brush.rect((-half, half), (0.58, 0.64), _SPANDREL)
    for a in np.arange(-half + 0.3, half, 0.3 if side else 0.36):
        brush.rect((a - 0.1, a + 0.1), (0.06, 0.36), _GLASS)
        brush.disc((a, 0.36), 0.1, _GLASS)
        brush.rect((a - 0.1, a + 0.1), (0.3, 0.33), _GOLD)


def _paint_block(brush: Brush, across: Span, upward: Span) -> None:
    """Piers, spandrels and windows between trimmed edges."""
    bays = max(3, round((across[1] - across[0]) / 0.2))
    pitch = (across[1] - across[0]) / bays
    storeys = round((upward[1] - upward[0] - 0.12) / 0.2)
    height = (upward[1] - upward[0] - 0.12) / storeys
    brush.rect(across, upward, _PIER)
    for bay in range(bays):
        a = across[0] + (bay + 0.5) * pitch
        brush.rect((a - pitch * 0.3, a + pitch * 0.3), (upward[0], upward[1] - 0.12), _SPANDREL)
        for storey in range(storeys):
            b = upward[0] + (storey + 0.5) * height
            lit = (bay * 7 + storey * 5) % 11 == 0
            brush.rect((a - pitch * 0.24, a + pitch * 0.24), (b - 0.055, b + 0.065), _LIT if lit else _GLASS)
    brush.rect(across, (upward[1] - 0.1, upward[1]), _TRIM)
    brush.rect(across, (upward[1] - 0.1, upward[1] - 0.085), _SPANDREL)
    for start, sign in ((across[0], 1), (across[1], -1)):
        brush.rect((start, start + sign * pitch * 0.16), upward, _TRIM)


def _paint_entrance(brush: Brush) -> None:
    brush.rect((-0.6, 0.6), (0, 1.0), _TRIM)
    for a in (-0.36, 0.0, 0.36):
        brush.rect((a - 0.13, a + 0.13), (0.04, 0.44), _GLASS)
        brush.rect((a - 0.01, a + 0.01), (0.04, 0.44), _GOLD)
