"""A sheet as recorded drawing primitives with roles, for every export format to replay.

Coordinates are mm from the lower left corner of the paper, y up, at true scale.
"""

from dataclasses import dataclass, replace
from enum import Enum
from textwrap import wrap
from typing import Literal

from popsim.geometry.arrays import FloatArray, locked
from popsim.geometry.flat import flat_motion

Anchor = Literal["start", "middle", "end"]


class Meaning(Enum):
    """What marks can mean; each kind of drawing lists its own, and a style says how each looks."""


class Role(Meaning):
    """What a mark on a sheet that is cut means; the value names its layer."""

    PRINT = "print"
    GLUE = "glue"
    CUT = "cut"
    MOUNTAIN = "mountain"
    VALLEY = "valley"
    LABEL = "label"
    REGISTRATION = "registration"


@dataclass(frozen=True, eq=False)
class Line:
    """A polyline (n, 2); `closed` joins its end to its start.

    `looks` draws it as lines of another role look without being one: samples in the legend are not cut.
    """

    role: Meaning
    points: FloatArray
    closed: bool = False
    looks: Meaning | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", locked(self.points, (None, 2), "line"))


@dataclass(frozen=True, eq=False)
class Area:
    """A filled area: rings (n, 2), even-odd."""

    role: Meaning
    rings: tuple[FloatArray, ...]
    looks: Meaning | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "rings", tuple(locked(ring, (None, 2), "area") for ring in self.rings))


@dataclass(frozen=True, eq=False)
class Text:
    """A line of text at its baseline: `size` of the font and `at` (2,) in mm, `angle` in radians.

    `halo` puts a rim of white round the letters, which stand on a picture.
    """

    role: Meaning
    text: str
    at: FloatArray
    size: float
    angle: float = 0.0
    anchor: Anchor = "start"
    bold: bool = False
    halo: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", locked(self.at, (2,), "text"))


@dataclass(frozen=True, eq=False)
class Picture:
    """An image clipped to rings (even-odd).

    Attributes
    ----------
    image:
        Path relative to the folder of the textures.
    frame:
        Matrix (3, 3) from the unit square (lower left to upper right of the image) to the sheet.
    clip:
        Rings, each (n, 2).
    """

    role: Meaning
    image: str
    frame: FloatArray
    clip: tuple[FloatArray, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "frame", locked(self.frame, (3, 3), "picture frame"))
        object.__setattr__(self, "clip", tuple(locked(ring, (None, 2), "clip") for ring in self.clip))


Mark = Line | Area | Text | Picture


@dataclass(frozen=True, eq=False)
class Sheet:
    """One side of a sheet of paper: its size in mm, and marks in drawing order.

    `suffix` is what its file ends with where each has its own.
    """

    name: str
    width: float
    height: float
    marks: tuple[Mark, ...]
    suffix: str = ""

    def of(self, *roles: Meaning) -> tuple[Mark, ...]:
        """The marks of some roles, in drawing order."""
        return tuple(mark for mark in self.marks if mark.role in roles)


def shifted(mark: Mark, by: FloatArray) -> Mark:
    """The same mark, moved by (2,) mm."""
    match mark:
        case Line():
            return replace(mark, points=mark.points + by)
        case Area():
            return replace(mark, rings=tuple(ring + by for ring in mark.rings))
        case Text():
            return replace(mark, at=mark.at + by)
        case Picture():
            frame = flat_motion(0.0, by) @ mark.frame
            return replace(mark, frame=frame, clip=tuple(ring + by for ring in mark.clip))


TEXT_WIDTH = 0.62
"""Width of a letter in font sizes, a little above the mean of the sans font that is embedded."""


HALO = 0.3
"""Width of the rim of white round a text, on all sides together, of the size of the font."""


def text_width(text: str, size: float) -> float:
    """Estimated width of a text, mm."""
    return TEXT_WIDTH * size * len(text)


def wrapped(text: str, size: float, width: float, *, letter: float = TEXT_WIDTH) -> list[str]:
    """Lines of a text that are estimated to be at most `width` mm wide; a single longer word stays whole.

    `letter` is the width of a letter in font sizes: less in sentences, with their spaces, than in numbers.
    """
    return wrap(text, max(1, int(width / (letter * size))), break_long_words=False)
