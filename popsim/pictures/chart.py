"""Curves against the fold angle in panels above each other, as strokes and words on a plane."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray

WIDTH, TOP, HEIGHT, GAP = 720, 60, 150, 38
"""Of the figure, of its head, of a panel, and between panels, px."""

LEFT, RIGHT, FOOT = 64, 20, 46
"""Margins, px."""

INK, GREY, PALE, RED = "#333333", "#777777", "#dddddd", "#c1121f"
"""Of words and axes, of small words, of grid lines, of limits."""

TINY = 1e-10
"""What is drawn on a logarithmic axis for less: rounding."""

Coordinates = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Stroke:
    """A line through points (px, y down), `width` px wide; a single point is a dot."""

    points: Coordinates
    colour: str
    width: float = 1.0
    dashed: bool = False


@dataclass(frozen=True)
class Words:
    """Text; `anchor` is "start", "middle" or "end" of its base line."""

    text: str
    at: tuple[float, float]
    size: int = 12
    colour: str = INK
    anchor: str = "start"


Shape = Stroke | Words


@dataclass(frozen=True, eq=False)
class Curve:
    """Values (n,) against fold angles in degrees (n,); dots where `dotted`."""

    degrees: FloatArray
    values: FloatArray
    colour: str
    dashed: bool = False
    dotted: bool = False


@dataclass(frozen=True, eq=False)
class Panel:
    """One diagram: curves, limits with their names (at least one), and a note where nothing is drawn."""

    title: str
    curves: tuple[Curve, ...]
    limits: tuple[tuple[str, float], ...]
    logarithmic: bool = True
    note: str = ""


def size_of(panels: Sequence[Panel]) -> tuple[int, int]:
    """Width and height of the figure, px."""
    return WIDTH, TOP + len(panels) * (HEIGHT + GAP) + FOOT - GAP


def draw(title: str, keys: Sequence[tuple[str, str, bool]], panels: Sequence[Panel]) -> list[Shape]:
    """The whole figure; `keys` are names of curves with their colour and whether they are dashed."""
    shapes: list[Shape] = [Words(title, (LEFT, 24), 15)]
    right = float(WIDTH - RIGHT)
    for name, colour, dashed in reversed(keys):
        shapes.append(Words(name, (right, 24), 12, INK, "end"))
        right -= 7.0 * len(name) + 6
        shapes.append(Stroke(((right - 24, 20), (right, 20)), colour, 2.0, dashed))
        right -= 40
    for index, panel in enumerate(panels):
        shapes += _panel(panel, float(TOP + index * (HEIGHT + GAP)))
    bottom = size_of(panels)[1]
    for degrees in range(0, 181, 30):
        shapes.append(Words(str(degrees), (_across(degrees), bottom - FOOT + 16), 11, GREY, "middle"))
    shapes.append(Words("fold angle, degrees (180: open)", (_across(90), bottom - 10), 12, INK, "middle"))
    return shapes


def _panel(panel: Panel, top: float) -> Iterator[Shape]:
    low, high, ticks = _axis(panel)
    bottom, left, right = top + HEIGHT, float(LEFT), float(WIDTH - RIGHT)

    def down(value: float) -> float:
        level = np.log10(max(value, TINY)) if panel.logarithmic else value
        return float(bottom - (np.clip(level, low, high) - low) / (high - low) * HEIGHT)

    for degrees in range(0, 181, 30):
        yield Stroke(((_across(degrees), top), (_across(degrees), bottom)), PALE)
    for tick in ticks:
        yield Stroke(((left, down(tick)), (right, down(tick))), PALE)
        yield Words(f"{tick:g}", (left - 6, down(tick) + 4), 11, GREY, "end")
    yield Words(panel.title, (left, top - 6))
    for name, value in panel.limits:
        yield Stroke(((left, down(value)), (right, down(value))), RED, 1.0, True)
        above = down(value) - 4 if down(value) > top + 16 else down(value) + 13
        yield Words(f"{name} {value:g}", (right - 4, above), 11, RED, "end")
    for curve in panel.curves:
        yield from _curve(curve, down)
    if panel.note:
        yield Words(panel.note, (_across(90), top + HEIGHT / 2), 12, GREY, "middle")
    yield Stroke(((left, top), (right, top), (right, bottom), (left, bottom), (left, top)), INK)


def _axis(panel: Panel) -> tuple[float, float, list[float]]:
    """Lower and upper end (their logarithms on a logarithmic axis) and the values of grid lines."""
    drawn = [curve.values[np.isfinite(curve.values)] for curve in panel.curves]
    values = np.concatenate([*drawn, [limit for _, limit in panel.limits]])
    if panel.logarithmic:
        levels = np.log10(np.maximum(values, TINY))
        low, high = max(np.floor(levels.min() - 0.3), np.log10(TINY)), np.ceil(levels.max() + 0.3)
        step = max(1, int(np.ceil((high - low) / 5)))
        return float(low), float(high), [10.0**level for level in np.arange(low, high + 0.5, step)]
    low, high = 1.25 * float(values.min(initial=0.0)), 1.25 * float(values.max(initial=0.0))
    if low == high:
        high = 1.0
    step = 10.0 ** np.floor(np.log10((high - low) / 2))
    step *= next(factor for factor in (5, 2, 1) if (high - low) / (factor * step) >= 3)
    return low, high, [step * number for number in range(int(np.ceil(low / step)), int(np.ceil(high / step)))]


def _curve(curve: Curve, down: Callable[[float], float]) -> Iterator[Stroke]:
    """The curve, broken where a value is no finite number."""
    sound = np.isfinite(curve.values)
    for part in np.split(np.arange(len(sound)), np.flatnonzero(~sound)):
        inside = part[sound[part]]
        points = tuple((_across(curve.degrees[k]), down(float(curve.values[k]))) for k in inside)
        if len(points) > 1:
            yield Stroke(points, curve.colour, 1.5, curve.dashed)
        if curve.dotted or len(points) == 1:
            yield from (Stroke((point,), curve.colour, 5.0) for point in points)


def _across(degrees: float) -> float:
    """Left is open: the card closes from left to right."""
    return float(LEFT + (180 - degrees) / 180 * (WIDTH - LEFT - RIGHT))
