"""A steamer whose hull flares upwards and narrows to the bow; coloured by material. y up, sailing towards +z."""

import numpy as np

from modelling.mesh import FloatArray, Mesh, both_sides, coloured, joined
from modelling.polygon import Point
from modelling.shapes import box, circle, cylinder, loft, prism, rounds

COLOURS = {
    "bottom": (0.66, 0.19, 0.16),
    "hull": (0.12, 0.25, 0.40),
    "white": (0.96, 0.95, 0.92),
    "deck": (0.80, 0.62, 0.40),
    "glass": (0.20, 0.42, 0.56),
    "funnel": (0.93, 0.67, 0.16),
    "black": (0.14, 0.14, 0.16),
    "boat": (0.91, 0.42, 0.16),
}

_STERN, _BOW = -3.1, 3.4  # ends of the deck
_LEVELS = (  # height, half width, shift of the stern and of the bow
    (0.0, 0.55, 0.5, -0.9),
    (0.4, 0.72, 0.3, -0.6),
    (1.05, 0.94, 0.05, -0.1),
    (1.25, 1.0, 0.0, 0.0),
)
_STATIONS = 16
_DECK = 1.25


def ship() -> Mesh:
    """Return the ship; the material names are the keys of COLOURS."""
    return joined([*_hull(), *_houses(), *_funnels(), both_sides(joined([*_windows(), *_boats()]))])


def _outline(level: tuple[float, float, float, float], inset: float = 0.0) -> list[Point]:
    """Plan (x, z) of the hull at a level, from the stern along starboard and back."""
    _, half, stern, bow = level
    t = np.linspace(0, 1, _STATIONS)
    taper = np.clip((t - 0.45) / 0.55, 0, 1)
    width = half * (1 - taper**2) * (1 - 0.22 * np.clip(1 - t / 0.25, 0, 1) ** 2)
    width = np.maximum(width - inset, 0.004)
    z = _STERN + stern + inset + t * (_BOW + bow - _STERN - stern - 2.5 * inset)
    right = [(float(x), float(c)) for x, c in zip(width, z, strict=True)]
    return right + [(-x, c) for x, c in reversed(right)]


def _ring(level: tuple[float, float, float, float]) -> FloatArray:
    return np.array([(x, level[0], z) for x, z in _outline(level)])


def _hull() -> list[Mesh]:
    rings = [_ring(level) for level in _LEVELS]
    names = ("bottom", "hull", "white")
    parts = [coloured(loft([a, b]), n) for a, b, n in zip(rings[:-1], rings[1:], names, strict=True)]
    parts.append(coloured(prism(_outline(_LEVELS[-1], 0.05), "y", _DECK - 0.02, _DECK + 0.02), "deck"))
    forecastle = [(x, z) for x, z in _outline(_LEVELS[-1]) if z > 1.85]
    parts.append(coloured(prism(forecastle, "y", _DECK, _DECK + 0.24), "white"))
    smaller = [(x * 0.92, z - 0.05) for x, z in forecastle]
    parts.append(coloured(prism(smaller, "y", _DECK + 0.2, _DECK + 0.26), "deck"))
    return parts


def _houses() -> list[Mesh]:
    """Three stepped decks with overhanging roofs, the bridge in front."""
    parts = []
    for half, stern, bow, low, high in (
        (0.74, -2.3, 1.45, _DECK, 1.75),
        (0.6, -1.9, 1.15, 1.75, 2.2),
        (0.62, 0.3, 1.0, 2.2, 2.6),
    ):
        parts.append(coloured(box((-half, low, stern), (half, high, bow)), "white"))
        edge = 0.05
        roof = box((-half - edge, high - 0.04, stern - edge), (half + edge, high + 0.02, bow + edge))
        parts.append(coloured(roof, "deck"))
    parts.append(coloured(box((-0.54, 2.32, 1.0), (0.54, 2.5, 1.015)), "glass"))
    for x in np.linspace(-0.45, 0.45, 5):
        parts.append(coloured(box((x - 0.07, 1.9, 1.15), (x + 0.07, 2.06, 1.165)), "glass"))
        parts.append(coloured(box((x - 0.07, 1.45, 1.45), (x + 0.07, 1.61, 1.465)), "glass"))
    parts.append(coloured(cylinder(0.035, "y", 2.6, 3.6, 8), "white").moved(0, 0, 0.6))
    parts.append(coloured(cylinder(0.035, "y", _DECK, 2.7, 8), "white").moved(0, 0, 2.5))
    parts.append(coloured(box((-0.3, 3.2, 0.58), (0.3, 3.24, 0.62)), "white"))
    return parts


def _funnels() -> list[Mesh]:
    bands = ((2.2, 2.65, 0.27, "funnel"), (2.65, 2.8, 0.28, "white"), (2.8, 3.05, 0.27, "black"))
    parts = []
    for z in (-0.45, -1.35):
        for low, high, radius, name in bands:
            shift = 0.12 * (np.array([low, high]) - 2.2)  # raked aft
            rings = [
                [(x, y, c * 1.25 + z - s) for x, c in circle(radius, 20)]
                for y, s in zip((low, high), shift, strict=True)
            ]
            parts.append(coloured(loft(rings), name))
    return parts


def _windows() -> list[Mesh]:
    """Starboard portholes and hawse in the hull, windows in the houses."""
    parts = []
    for z in np.arange(-2.5, 1.3, 0.38):
        parts.append(coloured(_stud((0.8, float(z)), 0.1, 0.015), "white"))
        parts.append(coloured(_stud((0.8, float(z)), 0.07, 0.025), "glass"))
    parts.append(coloured(_stud((0.85, 2.3), 0.06, 0.015), "black"))
    for z in np.arange(-2.05, 1.3, 0.4):
        parts.append(coloured(box((0.74, 1.42, z - 0.1), (0.755, 1.62, z + 0.1)), "glass"))
    for z in np.arange(-0.1, 1.0, 0.4):
        parts.append(coloured(box((0.6, 1.88, z - 0.1), (0.615, 2.06, z + 0.1)), "glass"))
    parts.append(coloured(box((0.62, 2.32, 0.4), (0.635, 2.5, 0.9)), "glass"))
    return parts


def _wall_at(height: float, z: float) -> float:
    """Half width of the hull at a height between the second and the third level."""
    low, high = _LEVELS[1], _LEVELS[2]
    share = (height - low[0]) / (high[0] - low[0])
    widths = []
    for level in (low, high):
        right = np.array(_outline(level)[:_STATIONS])
        widths.append(np.interp(z, right[:, 1], right[:, 0]))
    return float(widths[0] + share * (widths[1] - widths[0]))


def _stud(centre: Point, radius: float, height: float) -> FloatArray:
    """A flat disc that lies against the slanted wall about centre (y, z)."""
    y, z = centre
    rim = [(y + dy, z + dz) for dz, dy in circle(radius, 14)]
    return loft([[(_wall_at(b, c) + shift, b, c) for b, c in rim] for shift in (-0.03, height)])


def _boats() -> list[Mesh]:
    """Starboard lifeboats on their stands."""
    parts = []
    for z in (-1.6, -0.8):
        rows = rounds((-0.3, -0.22, 0.22, 0.3), (0.02, 0.1, 0.1, 0.02), "z", 10)
        parts.append(coloured(rows, "boat").moved(0.72, 1.92, z))
        parts += [
            coloured(box((0.7, 1.75, z + d - 0.02), (0.74, 1.86, z + d + 0.02)), "white") for d in (-0.18, 0.18)
        ]
    return parts
