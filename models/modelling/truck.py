"""A delivery truck: box body, cab with windscreen and bonnet, four wheels. y up, driving towards +z."""

from PIL import Image

from modelling.atlas import Atlas, Skin, View, plain
from modelling.brush import Brush
from modelling.mesh import Mesh, both_sides, joined
from modelling.shapes import arch, box, cylinder
from modelling.vehicle import body, paint_wheel, wheel

_SCALE = 190  # pixels per unit
_WHEEL, _WELL = 0.5, 0.6  # radii of wheel and arch
_FRONT_AXLE, _REAR_AXLE = 2.35, -1.85  # z
_BOX, _CAB = 1.0, 0.93  # half widths

_CREAM, _SHADE, _RED, _DEEP_RED = "#f7f0df", "#e3d8bf", "#d8432f", "#a82c20"
_NAVY, _YELLOW, _GLASS, _SKY = "#1f3358", "#f2b632", "#2e4a66", "#7fb0d0"
_DARK, _STEEL, _CHROME, _LAMP = "#26262b", "#8a9099", "#d5d9de", "#fff6cf"


def truck() -> tuple[Mesh, Image.Image]:
    """Return the truck and its texture."""
    atlas = Atlas(1280)
    skin = _views(atlas)
    colours = {name: atlas.swatch(name) for name in (_DARK, _STEEL, _CHROME, _LAMP, _RED, _YELLOW, _NAVY)}
    disc = atlas.view("+x", (-0.52, 0.52), (-0.52, 0.52), _SCALE, _DARK)
    paint_wheel(disc.brush, _WHEEL, _CHROME, _RED, 8)
    parts = [*_bodies(skin, colours[_DARK]), _wheels(disc, colours[_DARK]), _fittings(colours)]
    return atlas.finished(parts)


def _views(atlas: Atlas) -> dict[str, View]:
    length, height, width = (-3.1, 3.25), (0.45, 3.05), (-1.02, 1.02)
    skin = {
        "-x": atlas.view("-x", length, height, _SCALE, _CREAM),
        "+x": atlas.view("+x", length, height, _SCALE, _CREAM),
        "+z": atlas.view("+z", width, height, _SCALE, _CREAM),
        "-z": atlas.view("-z", width, height, _SCALE, _CREAM),
        "+y": atlas.view("+y", length, width, 76, _SHADE, up="x"),
        "-y": atlas.swatch(_DARK),
    }
    for side in ("-x", "+x"):
        _paint_cargo_side(skin[side].brush)
        _paint_cab_side(skin[side].brush)
    _paint_front(skin["+z"].brush)
    _paint_rear(skin["-z"].brush)
    _paint_top(skin["+y"].brush)
    return skin


def _bodies(skin: Skin, dark: View) -> list[Mesh]:
    cargo = [(-3.0, 0.72), *arch((_REAR_AXLE, 0.5), _WELL, 0.72), (0.95, 0.72), (0.95, 3.0), (-3.0, 3.0)]
    cab = [(1.0, 0.5), *arch((_FRONT_AXLE, 0.5), _WELL, 0.5), (3.1, 0.5), (3.1, 1.36), (3.0, 1.47), (2.5, 1.6)]
    cab += [(2.13, 2.37), (2.0, 2.45), (1.0, 2.45)]
    chassis = plain(box((-0.6, 0.5, -2.9), (0.6, 0.74, 1.1)), dark)
    return [
        body(cargo, _BOX, skin, dark, 0.5 + _WELL),
        body(cab, _CAB, skin, dark, 0.5 + _WELL),
        chassis,
    ]


def _wheels(disc: View, rubber: View) -> Mesh:
    one = wheel(_WHEEL, 0.32, disc, rubber)
    return both_sides(joined([one.moved(0.65, 0.5, z) for z in (_FRONT_AXLE, _REAR_AXLE)]))


def _fittings(colours: dict[str, View]) -> Mesh:
    """Bumpers, lamps, mirrors, steps and tanks."""
    middle = [
        plain(box((-0.98, 0.42, 3.08), (0.98, 0.66, 3.2)), colours[_STEEL]),
        plain(box((-0.95, 0.45, -3.08), (0.95, 0.62, -2.95)), colours[_STEEL]),
        *(plain(box((x - 0.06, 2.45, 1.75), (x + 0.06, 2.52, 1.87)), colours[_YELLOW]) for x in (-0.5, 0, 0.5)),
    ]
    lamp = plain(cylinder(0.13, "z", 3.08, 3.14, 16), colours[_LAMP]).moved(0.68, 0.95, 0)
    rim = plain(cylinder(0.16, "z", 3.08, 3.12, 16), colours[_CHROME]).moved(0.68, 0.95, 0)
    tank = plain(cylinder(0.17, "z", -0.35, 0.75, 16), colours[_STEEL]).moved(0.74, 0.55, 0)
    sides = [
        lamp,
        rim,
        tank,
        plain(box((0.93, 1.55, 2.2), (1.14, 1.59, 2.24)), colours[_DARK]),
        plain(box((1.04, 1.5, 2.16), (1.16, 1.92, 2.25)), colours[_RED]),
        plain(box((0.62, 0.36, 1.05), (0.95, 0.5, 1.7)), colours[_STEEL]),
        plain(box((0.62, 0.3, -2.62), (0.95, 0.72, -2.58)), colours[_DARK]),
        plain(box((0.6, 0.66, -3.04), (0.9, 0.74, -2.98)), colours[_RED]),
    ]
    return joined([*middle, both_sides(joined(sides))])


def _paint_cargo_side(brush: Brush) -> None:
    brush.rect((-3.1, 0.98), (0.4, 0.98), _NAVY)
    brush.rect((-3.1, 0.98), (0.98, 1.06), _YELLOW)
    brush.polygon([(-3.1, 1.06), (-3.1, 1.75), (-2.35, 1.06)], _RED)
    brush.polygon([(-3.1, 1.83), (-3.1, 2.05), (-2.02, 1.06), (-2.26, 1.06)], _YELLOW)
    brush.rect((-3.1, 0.98), (2.86, 3.1), _SHADE)
    brush.rect((-3.1, 0.98), (2.83, 2.86), _RED)
    for z in (-3.0, 0.95):
        brush.rect((z - 0.06, z + 0.06), (0.4, 3.1), _SHADE)
    for i in range(27):
        brush.disc((-2.9 + 0.145 * i, 2.93), 0.016, _STEEL)
        brush.disc((-2.9 + 0.145 * i, 0.78), 0.012, _STEEL)
    _paint_crest(brush, (-1.02, 2.3))
    brush.text((-1.02, 1.66), "POPSIM", 0.46, _NAVY)
    brush.text((-1.02, 1.26), "PAPER DELIVERIES", 0.13, _RED)


def _paint_crest(brush: Brush, centre: tuple[float, float]) -> None:
    """An open card with a box standing in it."""
    a, b = centre
    brush.polygon([(a - 0.78, b - 0.2), (a, b + 0.04), (a, b + 0.44), (a - 0.78, b + 0.2)], _YELLOW)
    brush.polygon([(a + 0.78, b - 0.2), (a, b + 0.04), (a, b + 0.44), (a + 0.78, b + 0.2)], "#d99a1f")
    brush.polygon([(a - 0.3, b - 0.1), (a, b - 0.2), (a, b + 0.12), (a - 0.3, b + 0.22)], _RED)
    brush.polygon([(a + 0.3, b - 0.1), (a, b - 0.2), (a, b + 0.12), (a + 0.3, b + 0.22)], _DEEP_RED)
    brush.polygon([(a - 0.3, b + 0.22), (a, b + 0.12), (a + 0.3, b + 0.22), (a, b + 0.32)], "#ef7a62")


def _paint_cab_side(brush: Brush) -> None:
    brush.rect((0.98, 3.25), (0.4, 2.6), _RED)
    brush.rect((0.98, 3.25), (0.4, 0.72), _DEEP_RED)
    brush.rect((0.98, 3.25), (1.2, 1.28), _YELLOW)
    brush.polygon([(1.93, 1.55), (1.93, 2.3), (2.0, 2.3), (2.36, 1.55)], _GLASS)
    brush.rect((1.2, 1.93), (1.55, 2.3), _GLASS, 0.05)
    brush.polygon([(1.28, 1.6), (1.55, 2.25), (1.75, 2.25), (1.48, 1.6)], _SKY)
    brush.rect((1.84, 1.88), (1.5, 2.34), _DEEP_RED)
    outline = [(1.12, 0.62), (1.12, 2.36), (2.03, 2.36), (2.42, 1.5), (2.42, 1.16)]
    brush.line(outline, _DEEP_RED, 0.022)
    brush.line([(1.12, 0.62), (1.76, 0.62)], _DEEP_RED, 0.022)
    brush.rect((1.2, 1.38), (1.36, 1.41), _CHROME, 0.015)
    brush.rect((2.62, 2.9), (1.34, 1.36), _DEEP_RED)
    wheel_arch = arch((_FRONT_AXLE, 0.5), _WELL + 0.035, 0.5, 32)
    brush.line(wheel_arch, _DEEP_RED, 0.07)
    brush.rect((2.98, 3.25), (1.0, 1.1), "#f08a24", 0.03)


def _paint_front(brush: Brush) -> None:
    brush.rect((-1.1, 1.1), (2.83, 2.86), _RED)
    brush.rect((-1.1, 1.1), (2.86, 3.1), _SHADE)
    brush.text((0, 2.65), "POPSIM", 0.17, _NAVY)
    brush.rect((-_CAB, _CAB), (0.4, 2.45), _RED)
    brush.rect((-0.8, 0.8), (1.63, 2.33), _DEEP_RED, 0.07)
    brush.rect((-0.77, 0.77), (1.66, 2.3), _GLASS, 0.05)
    brush.polygon([(-0.6, 1.68), (-0.25, 2.28), (0.05, 2.28), (-0.3, 1.68)], _SKY)
    brush.polygon([(0.15, 1.68), (0.5, 2.28), (0.58, 2.28), (0.23, 1.68)], _SKY)
    for a in (-0.45, 0.2):
        brush.line([(a, 1.66), (a + 0.35, 1.8)], _DARK, 0.03)
    brush.rect((-_CAB, _CAB), (1.2, 1.28), _YELLOW)
    brush.rect((-0.46, 0.46), (0.7, 1.16), _CHROME, 0.05)
    brush.rect((-0.42, 0.42), (0.74, 1.12), _DARK, 0.03)
    for i in range(5):
        brush.rect((-0.42, 0.42), (0.79 + 0.07 * i, 0.815 + 0.07 * i), _STEEL)
    brush.disc((0, 1.34), 0.07, _CHROME)
    brush.disc((0, 1.34), 0.05, _NAVY)
    for side in (-1, 1):
        brush.disc((side * 0.68, 0.95), 0.19, _DEEP_RED)
        brush.rect((side * 0.82, side * 0.92), (0.88, 1.04), "#f08a24", 0.02)


def _paint_rear(brush: Brush) -> None:
    brush.rect((-1.1, 1.1), (0.4, 0.98), _NAVY)
    brush.rect((-1.1, 1.1), (2.86, 3.1), _SHADE)
    brush.rect((-1.1, 1.1), (2.83, 2.86), _RED)
    for side in (-1, 1):
        across = (side * 0.02, side * 0.9)
        brush.rect(across, (1.02, 2.76), _CREAM, 0.02, line=_STEEL, width=0.025)
        brush.rect((side * 0.12, side * 0.8), (1.2, 1.26), _YELLOW)
        brush.rect((side * 0.12, side * 0.8), (1.3, 1.5), _RED)
        brush.line([(side * 0.16, 1.05), (side * 0.16, 2.72)], _STEEL, 0.03)
        brush.rect((side * 0.08, side * 0.34), (1.86, 1.91), _DARK, 0.02)
        for b in (1.2, 1.9, 2.6):
            brush.rect((side * 0.84, side * 0.97), (b - 0.035, b + 0.035), _STEEL, 0.01)
        brush.rect((side * 0.64, side * 0.92), (0.8, 0.93), _RED, 0.03)
        brush.rect((side * 0.5, side * 0.62), (0.8, 0.93), "#f08a24", 0.03)
    brush.rect((-0.28, 0.28), (0.78, 0.94), _CREAM, 0.02, line=_DARK, width=0.015)
    brush.text((0, 0.86), "POP 180", 0.085, _DARK)


def _paint_top(brush: Brush) -> None:
    brush.rect((-3.1, 0.97), (-1.1, 1.1), _CREAM)
    for i in range(6):
        brush.rect((-3.0 + 0.79 * i - 0.02, -3.0 + 0.79 * i + 0.02), (-1.1, 1.1), _SHADE)
    brush.rect((-2.9, 0.85), (-0.9, 0.9), _CREAM, 0.02, line=_SHADE, width=0.04)
    brush.rect((0.98, 3.25), (-1.1, 1.1), _RED)
    brush.rect((1.2, 1.65), (-0.4, 0.4), _DEEP_RED, 0.05)
    for b in (-0.35, 0.35):
        brush.rect((2.55, 3.0), (b - 0.02, b + 0.02), _DEEP_RED)
