"""The model and its card sized for each other: pages that fit a sheet, or a model that fits the given card."""

from pathlib import Path

import numpy as np

from popsim.design import Card, Design
from popsim.errors import InputError
from popsim.fitting import Fit
from popsim.geometry.arrays import FloatArray
from popsim.layout import find_paper
from popsim.patches import Painted
from popsim.pipeline.page import Page, needed_page, reached
from popsim.pipeline.painter import Painter
from popsim.pipeline.prepare import Prepared, Scale, check_size
from popsim.pipeline.settings import RunSettings

SPARSE = 0.3
"""Share of its faces on which a mechanism must show the model to be worth its paper."""

CLEARANCE = 0.97
"""Pages are made to use this much of a sheet, so that rounding up still fits."""

SNUG = 0.995
"""A model is made to use this much of a given card: contours do not scale exactly."""

FULL = 1.02
"""A card that would hold a model larger by less is full."""

ROUNDS = 6
"""How often a model is scaled to a given card; two or three do."""


def sized(prepared: Prepared, fit: Fit, settings: RunSettings, path: Path) -> tuple[Painter, Design, list[str]]:
    """Return a painter with pages of the right size, its first design, and what had to be changed for it.

    What shows almost nothing of the model once its contours are cut is left out.

    Raises
    ------
    InputError
        The card that is given cannot hold a model of the size that is given.
    """
    painter, painted, design = _drawn(prepared, fit, settings, path)
    notes = []
    sparse = [name for name, share in painted.coverage.items() if share < SPARSE]
    kept = fit.without(sparse)
    if kept is not None and kept.mechanisms != fit.mechanisms:
        notes.append(f"{len(sparse)} of the mechanisms would have shown almost nothing of the model: left out")
        fit = kept
        painter, painted, design = _drawn(prepared, fit, settings, path)
    if settings.pages:
        painter, design = _on_card(painter, painted, settings)
        longest = painter.prepared.longest
        notes.append(
            f"the folded card has {painter.page} ({settings.card}); the model is {longest:.1f} mm long on it"
        )
    else:
        painter, design = _on_sheets(painter, design, settings)
        if (longest := painter.prepared.longest) < prepared.longest:
            notes.append(f"scaled to {longest:.1f} mm so that each page fits a sheet of {settings.paper}")
    if isinstance(settings.size, Scale):
        notes.append(f"at a scale of {settings.size}, one unit of the file being {prepared.model.unit:g} mm")
    return painter, design, notes


def _drawn(
    prepared: Prepared, fit: Fit, settings: RunSettings, path: Path, page: Page | None = None
) -> tuple[Painter, Painted, Design]:
    painter = Painter(prepared, fit, settings.patches, path, page)
    return painter, *painter.make(frozenset(), prints=False)


def _scaled(
    painter: Painter, factor: float, settings: RunSettings, page: Page | None = None
) -> tuple[Painter, Painted, Design]:
    """All as large as `factor` says, on a page."""
    if factor == 1.0:
        return _drawn(painter.prepared, painter.fit, settings, painter.path, page)
    return _drawn(painter.prepared.scaled(factor), painter.fit.scaled(factor), settings, painter.path, page)


def _on_sheets(painter: Painter, design: Design, settings: RunSettings) -> tuple[Painter, Design]:
    """Make the model smaller until each page fits a sheet."""
    while not settings.exact_size and (shrink := _shrink(design.card, settings)) < 1:
        painter, _, design = _scaled(painter, shrink, settings)
    return painter, design


def _shrink(card: Card, settings: RunSettings) -> float:
    """Factor by which a card must shrink for a page and the flap on its fold to fit a sheet; 1 where they do."""
    page = np.array([card.x[1] - card.x[0], card.depth + settings.layout.seam_depth])
    sheet = np.array(settings.layout.area(find_paper(settings.paper)))
    room = max(float((sheet / page).min()), float((sheet[::-1] / page).min()))
    return 1.0 if room >= 1 else CLEARANCE * room


def _on_card(painter: Painter, painted: Painted, settings: RunSettings) -> tuple[Painter, Design]:
    """Make the model as large as the card that is given holds, or see that it holds the size that is given."""
    reach = _reach(painter, painted)
    page = max(settings.pages, key=lambda page: page.room(reach))
    for _ in range(ROUNDS):
        room = page.room(reach)
        if settings.exact_size or 1 <= room < FULL:
            break
        factor = SNUG * room
        check_size(painter.prepared.longest * factor, f"on a card of {page} the model would have {{}}")
        painter, painted, _ = _scaled(painter, factor, settings, page)
        reach = _reach(painter, painted)
    if page.room(reach) < 1:
        raise InputError(
            f"the closed pop-up needs a card of {needed_page(reach)} when folded; {settings.card} has {page}; "
            "give a larger card or a smaller size"
        )
    painter, _, design = _scaled(painter, 1.0, settings, page)
    return painter, design


def _reach(painter: Painter, painted: Painted) -> FloatArray:
    return reached(painter.fit.mechanisms, {name: shape.outline for name, shape in painted.shapes.items()})
