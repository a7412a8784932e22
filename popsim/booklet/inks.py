"""What marks of a booklet mean, and how they look: clear in grey print too, never by colour alone."""

from popsim.export.styles import Colour, Stroke, Style
from popsim.layout.sheet import Meaning

INK: Colour = (0.13, 0.14, 0.16)
PENCIL: Colour = (0.45, 0.47, 0.5)
LIGHT: Colour = (0.62, 0.64, 0.67)
GLUE_RED: Colour = (0.8, 0.12, 0.1)
ARROW_BLUE: Colour = (0.05, 0.3, 0.65)


class Ink(Meaning):
    """Fills first, then lines, then words."""

    PANEL = "panel"
    PAGE = "page"
    PAGE_REVERSE = "page-reverse"
    PAPER = "paper"
    PAPER_REVERSE = "paper-reverse"
    NEW = "new"
    NEW_REVERSE = "new-reverse"
    BUBBLE = "bubble"
    HATCH = "hatch"
    HATCH_BEHIND = "hatch-behind"
    RIM_BEHIND = "rim-behind"
    HIDDEN = "hidden"
    CREASE = "crease"
    MOUNTAIN = "mountain"
    VALLEY = "valley"
    EDGE = "edge"
    NEW_EDGE = "new-edge"
    RULE = "rule"
    ARROW_RIM = "arrow-rim"
    ARROW = "arrow"
    GLASS = "glass"
    LEADER = "leader"
    PICTURE = "picture"
    BADGE = "badge"
    TEXT = "text"
    NUMBER = "number"
    NOTE = "note"


def _fill(colour: Colour) -> Stroke:
    return Stroke(colour, 0.1)


STYLE = Style(
    "booklet",
    {
        Ink.PANEL: _fill((0.945, 0.95, 0.955)),
        Ink.PAGE: _fill((0.87, 0.89, 0.9)),
        Ink.PAGE_REVERSE: _fill((0.8, 0.82, 0.83)),
        Ink.PAPER: _fill((1.0, 1.0, 1.0)),
        Ink.PAPER_REVERSE: _fill((0.91, 0.91, 0.9)),
        Ink.NEW: _fill((1.0, 0.83, 0.35)),
        Ink.NEW_REVERSE: _fill((1.0, 0.93, 0.7)),
        Ink.BUBBLE: _fill((1.0, 1.0, 1.0)),
        Ink.HATCH: Stroke(GLUE_RED, 0.22),
        Ink.HATCH_BEHIND: Stroke(GLUE_RED, 0.14, (0.6, 0.7)),
        Ink.RIM_BEHIND: Stroke(GLUE_RED, 0.16),
        Ink.HIDDEN: Stroke(LIGHT, 0.13, (0.9, 0.7)),
        Ink.CREASE: Stroke(PENCIL, 0.13),
        Ink.MOUNTAIN: Stroke((0.85, 0.0, 0.0), 0.2, (2.2, 0.6, 0.4, 0.6)),
        Ink.VALLEY: Stroke((0.0, 0.2, 0.85), 0.2, (1.3, 0.7)),
        Ink.EDGE: Stroke(INK, 0.18),
        Ink.NEW_EDGE: Stroke(INK, 0.34),
        Ink.RULE: Stroke(LIGHT, 0.2),
        Ink.ARROW_RIM: Stroke((1.0, 1.0, 1.0), 1.5),
        Ink.ARROW: Stroke(ARROW_BLUE, 0.7),
        Ink.GLASS: Stroke(ARROW_BLUE, 0.25),
        Ink.LEADER: Stroke(INK, 0.12),
        Ink.PICTURE: _fill(INK),
        Ink.BADGE: Stroke(GLUE_RED, 0.2),
        Ink.TEXT: _fill(INK),
        Ink.NUMBER: _fill(ARROW_BLUE),
        Ink.NOTE: _fill(PENCIL),
    },
)
"""Printed sides are white, reverses grey; what is new is yellow with a bold edge."""
