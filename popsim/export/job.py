"""What a writer gets to write."""

from dataclasses import dataclass
from pathlib import Path

from popsim.export.styles import Style
from popsim.layout import Layout
from popsim.layout.sheet import Role, Sheet
from popsim.simulation import Sweep
from popsim.stock import CreaseAdvice

CREASES = (Role.MOUNTAIN, Role.VALLEY)


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
    sweep:
        The motion of the design, where it is known.
    """

    layout: Layout
    sheets: tuple[Sheet, ...]
    style: Style
    texture_root: Path
    title: str
    sweep: Sweep | None = None

    @property
    def crease_advice(self) -> CreaseAdvice | None:
        """How creases are prepared in the paper that was named, None where none was."""
        stock = self.layout.settings.stock
        return None if stock is None else stock.crease_advice


def own_file(path: Path, sheet: Sheet) -> Path:
    """Path of one sheet's file: "-1", "-1-reverse", "-2" ... or "-notes" before the suffix of `path`."""
    return path.with_name(f"{path.stem}-{sheet.suffix}{path.suffix}")
