"""The test build: one small box and one small v-fold on a card, to try printer, paper, knife and glue on."""

from pathlib import Path

from popsim.booklet import begun_picture
from popsim.design import Card, Design
from popsim.mechanisms import (
    MECHANISMS,
    BasePatchPair,
    Mechanism,
    Primitive,
    RectangularPrism,
    TriangularPrism,
    assemble,
    card_pair,
)
from popsim.pipeline.folder import fill_folder
from popsim.pipeline.planned import plan_sheets
from popsim.pipeline.prints import write_prints
from popsim.pipeline.settings import RunSettings
from popsim.simulation import Sweep

NAME = "Test build"

CARD = Card(x=(-65.0, 65.0), depth=45.0)
"""Goes onto one A4 or Letter sheet with all that stands on it."""

BOX = RectangularPrism((0.0, -12.0, 0.0), (40.0, 12.0, 15.0))
WEDGE = TriangularPrism((-40.0, -18.0, 0.0), (-22.0, 18.0, 18.0), edges="z", facing=-1)

CHECKS = (
    "Measure the bars: 5 cm and 2 in. If they are wrong, print again at 100 %, not fitted to the page.",
    "Score and fold: the paper must not crack, and each crease must lie on its dashed line.",
    "Glue: every flap must cover its grey place and not reach beyond it. If it does, cut more exactly.",
    "Close the card: it must lie flat by itself under a book, and nothing may stick out.",
    "Open it: box and wedge must stand up by themselves, with sharp edges and without a gap.",
)
"""What to look at."""


def calibration_design() -> Design:
    """A card with what represents a small box and a small wedge."""
    pair = card_pair(CARD)
    return assemble(CARD, [_first(BOX, pair, "M1"), _first(WEDGE, pair, "M2")])


def _first(primitive: Primitive, pair: BasePatchPair, name: str) -> Mechanism:
    """The first mechanism of the registry that represents `primitive`."""
    return next(found for kind in MECHANISMS.values() for found in kind.from_primitive(primitive, pair, name))


def deliver_calibration(
    sweep: Sweep, folder: Path, settings: RunSettings, *, footer: str, force: bool
) -> tuple[Path, ...]:
    """Write the sheet and the booklet of the test build.

    Parameters
    ----------
    sweep:
        The test build as it was folded.
    settings:
        Its paper, style and formats count.

    Returns
    -------
    The files written.

    Raises
    ------
    OutputError
        A file exists and `force` is false, or the folder cannot be written.
    """
    return fill_folder(folder, lambda own: write_calibration(sweep, own, settings, footer=footer), force=force)


def write_calibration(sweep: Sweep, folder: Path, settings: RunSettings, *, footer: str) -> list[Path]:
    """The same into a folder that is there already, whatever is in it."""
    picture = begun_picture(sweep.design, folder)
    planned = plan_sheets(sweep.design, sweep, paper=settings.paper, settings=settings.layout)
    return write_prints(
        planned, sweep.design, sweep, picture, folder, settings, name=NAME, footer=footer, checks=CHECKS
    )
