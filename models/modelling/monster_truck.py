"""A monster truck: a pick-up high above four large wheels. y up, driving towards +z."""

import numpy as np
from PIL import Image

from modelling.atlas import Atlas, Skin, View, plain
from modelling.brush import Brush, Colour
from modelling.mesh import Mesh, both_sides, joined
from modelling.polygon import Point
from modelling.shapes import arch, box, cylinder
from modelling.vehicle import body, paint_wheel, wheel

_SCALE = 130  # pixels per unit
_WHEEL, _WELL = 0.82, 0.96  # radii of wheel and arch
_AXLE = 1.4  # both axles lie at z = +-_AXLE
_HUB = 0.82  # their height
_HALF = 0.88  # half width of the body
_TAIL, _NOSE, _SILL = -2.3, 2.3, 1.3

_VIOLET, _DEEP, _ORANGE, _YELLOW = "#5b2d8e", "#3d1c63", "#f2701d", "#ffc933"
_DARK, _STEEL, _GLASS, _SKY, _LAMP, _RED = "#232328", "#9aa1aa", "#23384f", "#6fa6c8", "#fff6cf", "#d22f2f"


def monster_truck() -> tuple[Mesh, Image.Image]:
    """Return the monster truck and its texture."""
    atlas = Atlas(700)
    skin = _views(atlas)
    colours = {name: atlas.swatch(name) for name in (_DARK, _STEEL, _YELLOW, _LAMP, _VIOLET)}
    disc = atlas.view("+x", (-0.84, 0.84), (-0.84, 0.84), _SCALE, _DARK)
    paint_wheel(disc.brush, _WHEEL, _STEEL, _ORANGE, 10)
    one = wheel(_WHEEL, 0.68, disc, colours[_DARK], lugs=22)
    wheels = both_sides(joined([one.moved(0.66, _HUB, z) for z in (-_AXLE, _AXLE)]))
    return atlas.finished([_body(skin, colours[_DARK]), wheels, _frame(colours), _extras(colours)])


def _views(atlas: Atlas) -> dict[str, View]:
    length, height, width = (_TAIL, _NOSE), (_SILL - 0.02, 2.85), (-_HALF, _HALF)
    skin = {
        "-x": atlas.view("-x", length, height, _SCALE, _VIOLET),
        "+x": atlas.view("+x", length, height, _SCALE, _VIOLET),
        "+z": atlas.view("+z", width, height, _SCALE, _VIOLET),
        "-z": atlas.view("-z", width, height, _SCALE, _VIOLET),
        "+y": atlas.view("+y", length, width, _SCALE, _VIOLET, up="x"),
        "-y": atlas.swatch(_DARK),
    }
    for side in ("-x", "+x"):
        _paint_side(skin[side].brush)
    _paint_front(skin["+z"].brush)
    _paint_rear(skin["-z"].brush)
    _paint_top(skin["+y"].brush)
    return skin


def _body(skin: Skin, dark: View) -> Mesh:
    profile = [
        (_TAIL, _SILL),
        *arch((-_AXLE, _HUB), _WELL, _SILL),
        *arch((_AXLE, _HUB), _WELL, _SILL),
        *((_NOSE, _SILL), (_NOSE, 1.92), (2.2, 2.0), (0.95, 2.12), (0.55, 2.72), (0.45, 2.76)),
        *((-0.6, 2.76), (-0.68, 2.7), (-0.72, 2.1), (_TAIL, 2.1)),
    ]
    return body(profile, _HALF, skin, dark, _HUB + _WELL)


def _frame(colours: dict[str, View]) -> Mesh:
    """Chassis, axles and springs."""
    dark, steel, yellow = colours[_DARK], colours[_STEEL], colours[_YELLOW]
    parts = [plain(box((-0.45, 1.02, -1.9), (0.45, 1.32, 1.9)), dark)]
    for z in (-_AXLE, _AXLE):
        parts.append(plain(cylinder(0.13, "x", -0.7, 0.7, 12), steel).moved(0, _HUB, z))
        spring = plain(cylinder(0.08, "y", _HUB, 1.5, 10), yellow)
        parts += [spring.moved(x, 0, z + dz) for x in (-0.55, 0.55) for dz in (-0.3, 0.3)]
    return joined(parts)


def _extras(colours: dict[str, View]) -> Mesh:
    """Bull bar, roll bar with lamps, exhaust stacks and mirrors."""
    dark, steel, lamp = colours[_DARK], colours[_STEEL], colours[_LAMP]
    middle = [
        plain(box((-0.86, 1.24, 2.28), (0.86, 1.42, 2.42)), steel),
        plain(box((-0.8, 1.22, -2.42), (0.8, 1.38, -2.28)), steel),
        plain(box((-0.72, 2.82, -0.98), (0.72, 2.92, -0.88)), dark),
    ]
    for x in (-0.51, -0.17, 0.17, 0.51):
        middle.append(plain(cylinder(0.11, "z", -0.93, -0.8, 14), lamp).moved(x, 3.0, 0))
        middle.append(plain(cylinder(0.13, "z", -0.96, -0.83, 14), dark).moved(x, 3.0, 0))
    stack = plain(cylinder(0.07, "y", 2.0, 3.0, 12), steel).moved(0.6, 0, -1.2)
    sides = [
        plain(box((0.62, 2.05, -0.98), (0.72, 2.85, -0.88)), dark),
        stack,
        plain(box((_HALF, 2.14, 0.58), (1.0, 2.2, 0.64)), dark),
        plain(box((0.96, 2.08, 0.56), (1.08, 2.36, 0.66)), colours[_VIOLET]),
        plain(box((0.3, 1.42, 2.3), (0.38, 1.95, 2.38)), steel),
    ]
    return joined([*middle, both_sides(joined(sides))])


def _paint_side(brush: Brush) -> None:
    brush.rect((_TAIL, _NOSE), (_SILL - 0.1, 1.38), _DEEP)
    for colour, length in ((_ORANGE, 1.0), (_YELLOW, 0.72)):
        for tongue in _flames(length):
            brush.polygon(tongue, colour)
    _paint_door(brush)
    for z in (-_AXLE, _AXLE):
        brush.line(arch((z, _HUB), _WELL + 0.03, _SILL, 32), _DEEP, 0.08)
    brush.text((-1.5, 1.94), "FOLDZILLA", 0.17, _YELLOW)
    brush.rect((_TAIL, _TAIL + 0.12), (1.85, 2.0), _RED, 0.02)


def _paint_door(brush: Brush) -> None:
    brush.polygon([(0.1, 2.15), (0.1, 2.64), (0.5, 2.64), (0.83, 2.15)], _GLASS)
    brush.rect((-0.56, 0.02), (2.15, 2.64), _GLASS, 0.04)
    brush.polygon([(-0.4, 2.17), (-0.15, 2.62), (-0.02, 2.62), (-0.27, 2.17)], _SKY)
    brush.line([(-0.64, 1.45), (-0.64, 2.7)], _DEEP, 0.02)
    brush.line([(0.06, 1.45), (0.06, 2.7)], _DEEP, 0.02)
    brush.rect((-0.56, -0.38), (1.98, 2.02), _STEEL, 0.02)


def _flames(length: float) -> list[list[Point]]:
    """Tongues that lick back from the nose; `length` scales them."""
    rows = [(1.42, 1.62, 1.6, 2.0), (1.56, 1.8, 1.85, 3.0), (1.7, 2.0, 2.02, 2.3), (1.82, 2.12, 2.02, 1.5)]
    tongues = []
    for low, high, tip, reach in rows:
        t = np.linspace(0, 1, 16)
        back = _NOSE + 0.02 - reach * length * t
        middle = (low + high) / 2
        swing = 0.06 * np.sin(2.5 * np.pi * t) * t + (tip - middle) * t**2
        half = (high - low) / 2 * (1 - t**1.5) * (0.55 + 0.45 * length) + 0.04 * (1 - t)
        upper = [(float(a), float(b)) for a, b in zip(back, middle + swing + half, strict=True)]
        lower = [(float(a), float(b)) for a, b in zip(back, middle + swing - half, strict=True)]
        tongues.append(upper + lower[::-1])
    return tongues


def _paint_front(brush: Brush) -> None:
    brush.rect((-0.72, 0.72), (2.18, 2.68), _GLASS, 0.06)
    brush.polygon([(-0.55, 2.2), (-0.25, 2.66), (0.0, 2.66), (-0.3, 2.2)], _SKY)
    brush.rect((-_HALF, _HALF), (1.2, 1.96), _ORANGE)
    brush.rect((-0.5, 0.5), (1.46, 1.86), _DARK, 0.05)
    for i in range(9):
        brush.rect((-0.44 + 0.11 * i - 0.018, -0.44 + 0.11 * i + 0.018), (1.5, 1.82), _STEEL)
    for side in (-1, 1):
        brush.disc((side * 0.68, 1.7), 0.15, _STEEL)
        brush.disc((side * 0.68, 1.7), 0.12, _LAMP)
    _teeth(brush, 1.46, -0.09, _LAMP)
    _teeth(brush, 1.86, 0.09, _LAMP)


def _teeth(brush: Brush, level: float, drop: float, colour: Colour) -> None:
    """A row of teeth in the grille, pointing into it."""
    for i in range(8):
        a = -0.44 + 0.11 * i
        brush.polygon([(a, level), (a + 0.11, level), (a + 0.055, level - drop)], colour)


def _paint_rear(brush: Brush) -> None:
    brush.rect((-0.72, 0.72), (2.2, 2.66), _GLASS, 0.06)
    brush.rect((-0.6, 0.6), (1.5, 2.04), _DEEP, 0.03)
    brush.text((0, 1.78), "FOLDZILLA", 0.15, _YELLOW)
    for side in (-1, 1):
        brush.rect((side * 0.66, side * 0.82), (1.6, 2.0), _RED, 0.03)


def _paint_top(brush: Brush) -> None:
    brush.rect((_TAIL + 0.08, -0.78), (-0.78, 0.78), _DARK, 0.04)
    for i in range(6):
        brush.rect((-2.1 + 0.22 * i, -2.08 + 0.22 * i), (-0.7, 0.7), "#3a3a42")
    for side in (-1, 1):
        brush.polygon([(_NOSE, side * 0.1), (_NOSE, side * 0.34), (1.0, side * 0.22)], _ORANGE)
        brush.polygon([(_NOSE, side * 0.5), (_NOSE, side * 0.8), (1.2, side * 0.6)], _ORANGE)
    brush.rect((1.3, 1.85), (-0.2, 0.2), _DARK, 0.05)
