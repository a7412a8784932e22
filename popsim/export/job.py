"""What a writer gets to write."""

from dataclasses import dataclass
from pathlib import Path

from popsim.export.styles import Style
from popsim.layout import Layout
from popsim.layout.sheet import Sheet


@dataclass(frozen=True, eq=False)
class Job:
    """Everything that a format may show.

    Attributes
    ----------
    layout:
        Pieces and places.
    sheets:
        The layout drawn, then pages of text.
    style:
        How lines look.
    texture_root:
        The folder that pictures are relative to.
    title:
        Of the document.
    """

    layout: Layout
    sheets: tuple[Sheet, ...]
    style: Style
    texture_root: Path
    title: str


def numbered(path: Path, number: int) -> Path:
    """Path of one sheet's file: "-1", "-2" ... before the suffix."""
    return path.with_name(f"{path.stem}-{number}{path.suffix}")
