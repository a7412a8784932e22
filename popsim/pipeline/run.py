"""The seven stages, one after another."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from popsim.design import Card, Design
from popsim.fitting import Fit
from popsim.layout import find_paper
from popsim.patches import Painted
from popsim.pipeline.abstract import abstract
from popsim.pipeline.painter import Painter
from popsim.pipeline.prepare import Prepared, prepare
from popsim.pipeline.settings import RunSettings
from popsim.verification import Verdict, verify

Progress = Callable[[str], None]
"""Called with the name of each stage as it starts."""

SPARSE = 0.3
"""Share of its faces on which a mechanism must show the model to be worth its paper."""

CLEARANCE = 0.97
"""Pages are made to use this much of a sheet, so that rounding up still fits."""


@dataclass(frozen=True, eq=False)
class DesignRun:
    """A model and the design that was made from it.

    Attributes
    ----------
    settings:
        What was asked for.
    prepared, fit, painted:
        The model on the card, its prisms and mechanisms, its patches.
    design:
        The result.
    verdict:
        What verification says of it.
    notes:
        Everything that was assumed, added or left out, stage by stage, one sentence each.
    """

    settings: RunSettings
    prepared: Prepared
    fit: Fit
    painted: Painted
    design: Design
    verdict: Verdict
    notes: tuple[str, ...]


def run_design(
    path: Path, settings: RunSettings | None = None, progress: Progress = lambda stage: None
) -> DesignRun:
    """Make a verified design of a model; nothing is written.

    Raises
    ------
    MeshError
        The model cannot be read, or nothing of it can be folded.
    InputError
        An option cannot be met.
    """
    settings = settings or RunSettings()
    progress("aligning the model")
    prepared = prepare(path, settings.stance, settings.size, settings.seed)
    progress("fitting prisms")
    fit = abstract(prepared, settings.fit, settings.seed)
    progress("cutting patches")
    painter, design, notes = _sized(prepared, fit, settings, path)
    progress("folding it")
    held, verdict = painter.verified(design)
    progress("painting patches")
    painted, design = painter.make(held, prints=True)
    if _plain(design) != _plain(verdict.evidence.sweep.design):
        verdict = verify(design)  # prints do not move outlines; should they ever, the exported ones are judged
    prepared, fit = painter.prepared, painter.fit
    notes = [*prepared.model.notes, *prepared.alignment.reasons, *painted.notes, *notes]
    if fit.closed_gap:
        notes.append(f"gaps of up to {fit.closed_gap:.0f} mm were taken as solid to find the model's shape")
    if held:
        notes.append(f"contours cut back to their faces because they got in the way: {', '.join(sorted(held))}")
    return DesignRun(settings, prepared, fit, painted, design, verdict, tuple(notes))


def _plain(design: Design) -> Design:
    """The design without its prints."""
    bare = [patch.model_copy(update={"texture": None, "texture_frame": None}) for patch in design.patches]
    return design.model_copy(update={"patches": tuple(bare)})


def _sized(prepared: Prepared, fit: Fit, settings: RunSettings, path: Path) -> tuple[Painter, Design, list[str]]:
    """A painter whose pages fit a sheet, its first design, and what had to be changed for it.

    What shows almost nothing of the model once its contours are cut is left out.
    """
    notes = []
    painter = Painter(prepared, fit, settings.patches, path)
    painted, design = painter.make(frozenset(), prints=False)
    sparse = [name for name, share in painted.coverage.items() if share < SPARSE]
    kept = fit.without(sparse)
    if kept is not None and kept.mechanisms != fit.mechanisms:
        fit = kept
        notes.append(f"{len(sparse)} of the mechanisms would have shown almost nothing of the model: left out")
        painter = Painter(prepared, fit, settings.patches, path)
        painted, design = painter.make(frozenset(), prints=False)
    factor = 1.0
    while not settings.exact_size and (shrink := _shrink(design.card, settings)) < 1:
        factor *= shrink
        prepared, fit = prepared.scaled(shrink), fit.scaled(shrink)
        painter = Painter(prepared, fit, settings.patches, path)
        painted, design = painter.make(frozenset(), prints=False)
    if factor < 1:
        size = f"{settings.size * factor:.1f} mm"
        notes.append(f"scaled to {size} so that each page fits a sheet of {settings.paper}")
    return painter, design, notes


def _shrink(card: Card, settings: RunSettings) -> float:
    """Factor by which a card must shrink for a page and the flap on its fold to fit a sheet; 1 where they do."""
    page = np.array([card.x[1] - card.x[0], card.depth + settings.layout.seam_depth])
    sheet = np.array(settings.layout.area(find_paper(settings.paper)))
    room = max(float((sheet / page).min()), float((sheet[::-1] / page).min()))
    return 1.0 if room >= 1 else CLEARANCE * room
