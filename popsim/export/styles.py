"""Line styles by preset: communities disagree on what red means. None relies on colour alone."""

from collections.abc import Mapping
from dataclasses import dataclass

from popsim.errors import InputError
from popsim.layout.sheet import Meaning, Role

Colour = tuple[float, float, float]

WHITE: Colour = (1.0, 1.0, 1.0)
BLACK: Colour = (0.0, 0.0, 0.0)
GREY: Colour = (0.35, 0.35, 0.35)
PALE: Colour = (0.85, 0.85, 0.85)
RED: Colour = (0.85, 0.0, 0.0)
BLUE: Colour = (0.0, 0.2, 0.85)
GREEN: Colour = (0.0, 0.55, 0.1)
MAGENTA: Colour = (0.8, 0.0, 0.6)

FINEST = 0.0882
"""mm, a quarter of a point: thinner lines vanish on some printers."""

DASH = (2.0, 1.0)
DASH_DOT = (3.0, 0.8, 0.4, 0.8)
DOTS = (0.5, 0.9)


@dataclass(frozen=True)
class Stroke:
    """How lines of a role look: colour (RGB, 0..1), width in mm, dashes in mm (empty for solid)."""

    colour: Colour
    width: float
    dashes: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if self.width < FINEST:
            raise ValueError(f"lines must be at least {FINEST} mm wide, not {self.width}")


@dataclass(frozen=True)
class Style:
    """How the marks of a kind of drawing look, by role; areas and texts have the colour of its stroke."""

    name: str
    strokes: Mapping[Meaning, Stroke]

    def stroke(self, role: Meaning) -> Stroke:
        """The stroke of a role."""
        return self.strokes[role]


def _style(name: str, cut: Stroke, mountain: Stroke, valley: Stroke) -> Style:
    strokes: dict[Meaning, Stroke] = {
        Role.CUT: cut,
        Role.MOUNTAIN: mountain,
        Role.VALLEY: valley,
        Role.GLUE: Stroke(PALE, 0.1),
        Role.PRINT: Stroke(WHITE, 0.5),
        Role.LABEL: Stroke(GREY, 0.15),
        Role.REGISTRATION: Stroke(BLACK, 0.3),
    }
    return Style(name, strokes)


STYLES = {
    style.name: style
    for style in (
        _style("origami", Stroke(BLACK, 0.25), Stroke(RED, 0.25, DASH_DOT), Stroke(BLUE, 0.25, DASH)),
        _style("dieline", Stroke(MAGENTA, 0.35), Stroke(GREEN, 0.35, DASH_DOT), Stroke(GREEN, 0.35, DASH)),
        _style("silhouette", Stroke(RED, 0.1), Stroke(BLUE, 0.1, DASH_DOT), Stroke(GREEN, 0.1, DASH)),
        _style("cricut", Stroke(BLACK, 0.1), Stroke(RED, 0.1, DASH_DOT), Stroke(BLUE, 0.1, DASH)),
        _style("mono", Stroke(BLACK, 0.35), Stroke(BLACK, 0.2, DASH_DOT), Stroke(BLACK, 0.2, DASH)),
    )
}


def find_style(name: str) -> Style:
    """Return the preset called `name`.

    Raises
    ------
    InputError
        There is none; the message lists them.
    """
    if name not in STYLES:
        raise InputError(f"line style {name!r} is not known; give {', '.join(STYLES)}")
    return STYLES[name]
