"""A town hall: gabled main block, stepped wings, columned porch, clock tower. y up, its front faces +z."""

import numpy as np
from PIL import Image

from modelling.atlas import Atlas, View, around, everywhere, painted, plain
from modelling.facade import clock, courses, quoins, window, windows
from modelling.mesh import Mesh, both_sides, joined
from modelling.shapes import box, cylinder, frustum, prism, rounds

_SCALE = 120  # pixels per unit
_STONE, _JOINT, _PALE, _SLATE, _DARK_SLATE = "#e2b98a", "#cfa374", "#f5ead3", "#536878", "#41535f"
_GLASS, _DOOR, _GOLD, _PLINTH = "#34506b", "#6b3f26", "#d9a93c", "#b9a78c"
_FRAMES = (_PALE, _GLASS)

_WINGS = ((1.9, 3.0, 0.8, 1.55), (3.0, 3.8, 0.62, 1.05))  # from x, to x, half depth, height


def town_hall() -> tuple[Mesh, Image.Image]:
    """Return the town hall and its texture."""
    atlas = Atlas(1024)
    pale, plinth, gold = (atlas.swatch(c) for c in (_PALE, _PLINTH, _GOLD))
    parts = [*_tower(atlas, pale, gold), *_main_block(atlas, plinth), *_porch(atlas, pale)]
    wings = both_sides(joined(_wings(atlas, plinth)))
    return atlas.finished([*parts, wings])


def _wall(atlas: Atlas, facing: str, across: tuple[float, float], top: float) -> View:
    """A stone wall from the ground up with corner stones."""
    view = atlas.view(facing, across, (0.0, top), _SCALE, _STONE)
    courses(view.brush, across, (0.2, top), (0.32, 0.14), _JOINT)
    return view


def _roof(atlas: Atlas, across: tuple[float, float], half: float) -> View:
    view = atlas.view("+y", across, (-half, half), _SCALE * 0.7, _SLATE, up="z")
    courses(view.brush, across, (-half, half), (0.14, 0.1), _DARK_SLATE, width=0.012)
    return view


def _main_block(atlas: Atlas, plinth: View) -> list[Mesh]:
    front = _wall(atlas, "+z", (-1.9, 1.9), 2.2)
    quoins(front.brush, (-1.9, 1.9), (0.2, 2.04), (0.24, 0.14), _PALE)
    front.brush.rect((-1.9, 1.9), (2.05, 2.2), _PALE)
    front.brush.rect((-1.9, 1.9), (1.08, 1.14), _PALE)
    columns = [s * a for s in (-1, 1) for a in (1.18, 1.52)]
    windows(front.brush, columns, [0.68], (0.17, 0.5), _FRAMES)
    windows(front.brush, columns, [1.5], (0.17, 0.42), _FRAMES, arched=True)
    windows(front.brush, [-0.7, 0.7], [0.78], (0.2, 0.5), _FRAMES)
    front.brush.rect((-0.34, 0.34), (0.3, 1.3), _PALE)
    front.brush.disc((0, 1.2), 0.34, _PALE)
    front.brush.rect((-0.26, 0.26), (0.3, 1.2), _DOOR)
    front.brush.disc((0, 1.2), 0.26, _GLASS)
    front.brush.rect((-0.01, 0.01), (0.3, 1.2), "#3d2415")
    side = _wall(atlas, "+x", (-1.12, 1.12), 3.05)
    side.brush.rect((-1.12, 1.12), (2.05, 2.2), _PALE)
    window(side.brush, (0, 2.45), (0.26, 0.22), _FRAMES, arched=True)
    windows(side.brush, [-0.45, 0.45], [1.82], (0.18, 0.22), _FRAMES)
    roof = _roof(atlas, (-2.0, 2.0), 1.15)
    walls = {**everywhere(plinth), "+z": front, "-z": front, "+x": side, "-x": side}
    gable = [(-1.12, 2.2), (1.12, 2.2), (0.0, 3.0)]
    return [
        plain(box((-1.96, 0, -1.06), (1.96, 0.2, 1.06)), plinth),
        plain(box((-0.5, 0, -1.25), (0.5, 0.28, -0.9)), plinth),
        painted(box((-1.9, 0, -1), (1.9, 2.2, 1)), walls),
        painted(prism(gable, "x", -1.98, 1.98), {**everywhere(plinth), "+y": roof, "+x": side, "-x": side}),
    ]


def _wings(atlas: Atlas, plinth: View) -> list[Mesh]:
    """Wings of the right-hand side, lower step by step."""
    parts = []
    for start, end, half, top in _WINGS:
        front = _wall(atlas, "+z", (start, end), top)
        side = _wall(atlas, "+x", (-half, half), top + 0.5)
        columns = np.linspace(start, end, 2 + round((end - start) / 0.36))[1:-1].tolist()
        rows = [0.55] if top < 1.2 else [0.52, 1.12]
        windows(front.brush, columns, rows, (0.16, 0.3), _FRAMES)
        windows(side.brush, [-half / 2, 0, half / 2], rows, (0.16, 0.3), _FRAMES)
        for view, across in ((front, (start, end)), (side, (-half, half))):
            view.brush.rect(across, (top - 0.12, top), _PALE)
        quoins(front.brush, (end - 0.2, end), (0.2, top - 0.12), (0.2, 0.14), _PALE)
        walls = {**everywhere(plinth), "+z": front, "-z": front, "+x": side, "-x": side}
        gable = [(-half - 0.1, top), (half + 0.1, top), (0.0, top + 0.48)]
        roof = {**everywhere(plinth), "+y": _roof(atlas, (start, end + 0.1), half + 0.1), "+x": side, "-x": side}
        parts += [
            plain(box((start, 0, -half - 0.05), (end + 0.05, 0.2, half + 0.05)), plinth),
            painted(box((start, 0, -half), (end, top, half)), walls),
            painted(prism(gable, "x", start, end + 0.08), roof),
        ]
    return parts


def _tower(atlas: Atlas, pale: View, gold: View) -> list[Mesh]:
    across, low, high = (-0.56, 0.56), 2.1, 4.95
    wall = atlas.view("+z", across, (low, high), _SCALE * 1.3, _STONE)
    courses(wall.brush, across, (low, high), (0.28, 0.14), _JOINT)
    quoins(wall.brush, (-0.52, 0.52), (2.12, 4.1), (0.16, 0.14), _PALE)
    clock(wall.brush, (0, 3.68), 0.34)
    window(wall.brush, (0, 2.98), (0.2, 0.36), _FRAMES, arched=True)
    windows(wall.brush, [-0.2, 0.2], [4.48], (0.16, 0.3), (_PALE, "#2b2f36"), arched=True)
    spire = atlas.view("+z", (-0.6, 0.6), (4.9, 6.2), _SCALE, _SLATE)
    courses(spire.brush, (-0.6, 0.6), (4.9, 6.2), (0.14, 0.1), _DARK_SLATE, width=0.012)
    walls = {**everywhere(pale), **around(wall)}
    tiles = {**everywhere(pale), **around(spire)}
    return [
        painted(box((-0.52, low, -0.52), (0.52, 4.15, 0.52)), walls),
        plain(box((-0.6, 4.1, -0.6), (0.6, 4.22, 0.6)), pale),
        painted(box((-0.45, 4.22, -0.45), (0.45, 4.86, 0.45)), walls),
        plain(box((-0.54, 4.84, -0.54), (0.54, 4.94, 0.54)), pale),
        painted(frustum((0.58, 0.58), (0, 0), (4.94, 6.15), "y"), tiles),
        plain(rounds((6.05, 6.12, 6.19, 6.26, 6.33), (0.02, 0.06, 0.075, 0.06, 0.01), "y", 12), gold),
        plain(cylinder(0.015, "y", 6.3, 6.6, 8), gold),
    ]


def _porch(atlas: Atlas, pale: View) -> list[Mesh]:
    """Steps, six columns, and a pediment over them."""
    front = atlas.view("+z", (-1.05, 1.05), (1.6, 2.45), _SCALE, _PALE)
    front.brush.text((0, 1.72), "TOWN HALL", 0.13, _DOOR)
    front.brush.polygon([(-0.84, 1.9), (0.84, 1.9), (0, 2.29)], _STONE)
    front.brush.disc((0, 2.03), 0.1, _GOLD)
    front.brush.disc((0, 2.03), 0.07, "#9c2f2a")
    faces = {**everywhere(pale), "+z": front}
    parts = [plain(box((-1.1 - d, 0, 1), (1.1 + d, 0.3 - d, 1.62 + d)), pale) for d in (0.0, 0.1, 0.2)]
    for x in np.linspace(-0.88, 0.88, 6):
        shaft = rounds((0.3, 0.36, 0.4, 1.5, 1.54, 1.6), (0.11, 0.11, 0.08, 0.065, 0.1, 0.1), "y", 14)
        parts.append(plain(shaft, pale).moved(float(x), 0, 1.45))
    parts.append(painted(box((-1.0, 1.6, 1.0), (1.0, 1.84, 1.58)), faces))
    parts.append(painted(prism([(-1.05, 1.84), (1.05, 1.84), (0, 2.38)], "z", 0.95, 1.62), faces))
    return parts
