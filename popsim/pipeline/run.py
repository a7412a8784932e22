"""The seven stages, one after another."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from popsim.design import Card, Design, Source
from popsim.fitting import Fit
from popsim.geometry.arrays import FloatArray
from popsim.layout import find_paper
from popsim.mechanisms import assemble
from popsim.patches import Painted, paint
from popsim.pipeline.abstract import abstract
from popsim.pipeline.page import fitting_card
from popsim.pipeline.prepare import Prepared, prepare
from popsim.pipeline.settings import RunSettings
from popsim.pipeline.territory import territories
from popsim.rendering.ray_scene import RayScene
from popsim.verification import Verdict, verify

Progress = Callable[[str], None]
"""Called with the name of each stage as it starts."""

REPAIRS = 4
"""How often contours that got in the way are cut back to their faces before all of them are."""

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
    factor = 1.0 if settings.exact_size else _shrink(fit, settings)
    if factor < 1:
        prepared, fit = prepared.scaled(factor), fit.scaled(factor)
    progress("painting patches")
    painter = _Painter(prepared, fit, settings, path)
    painted, design = painter.paint(frozenset())
    progress("folding it")
    verdict = verify(design)
    held: frozenset[str] = frozenset()
    for attempt in range(REPAIRS):
        if verdict.passed:
            break
        held = painter.everything if attempt == REPAIRS - 1 else held | painter.in_the_way(verdict)
        painted, design = painter.paint(held)
        verdict = verify(design)
    notes = [*prepared.model.notes, *prepared.alignment.reasons, *painted.notes]
    if fit.closed_gap:
        notes.append(f"gaps of up to {fit.closed_gap:.0f} mm were taken as solid to find the model's shape")
    if factor < 1:
        notes.append(
            f"scaled to {settings.size * factor:.1f} mm so that each page fits a sheet of {settings.paper}"
        )
    if held:
        notes.append(f"contours cut back to their faces because they got in the way: {', '.join(sorted(held))}")
    return DesignRun(settings, prepared, fit, painted, design, verdict, tuple(notes))


class _Painter:
    """Paints the patches of a fit, holding some of them to their faces."""

    def __init__(self, prepared: Prepared, fit: Fit, settings: RunSettings, path: Path) -> None:
        self.prepared, self.fit, self.settings, self.path = prepared, fit, settings, path
        self.scene = RayScene(prepared.surface)
        self.territories = territories(fit.mechanisms, prepared.bounds)
        self.everything = frozenset(m.patch_id(p.role) for m in fit.mechanisms for p in m.plates())

    def paint(self, held: frozenset[str]) -> tuple[Painted, Design]:
        """Patches and design with the patches in `held` kept within their faces."""
        chosen = replace(self.settings.patches, within_face=held)
        painted = paint(self.fit.mechanisms, self.scene, self.territories, chosen)
        outlines: dict[str, FloatArray] = {name: shape.outline for name, shape in painted.shapes.items()}
        return painted, self._assembled(fitting_card(self.fit.mechanisms, outlines), painted)

    def in_the_way(self, verdict: Verdict) -> frozenset[str]:
        """Patches that verification found in collision; all of them if it names none."""
        found = {patch for contact in verdict.evidence.contacts for patch in contact.patches}
        return frozenset(found) & self.everything or self.everything

    def _assembled(self, card: Card, painted: Painted) -> Design:
        model = self.prepared.model
        rows = tuple((float(a), float(b), float(c), float(d)) for a, b, c, d in self.prepared.to_card)
        source = Source(file=self.path.name, sha256=model.sha256)
        return assemble(card, self.fit.mechanisms, painted.shapes, source=source, model_to_card=rows)


def _shrink(fit: Fit, settings: RunSettings) -> float:
    """Factor by which the model must shrink for each page to fit a sheet, at most 1."""
    card = fitting_card(fit.mechanisms)
    page = np.array([card.x[1] - card.x[0], card.depth])
    sheet = np.array(settings.layout.area(find_paper(settings.paper)))
    upright, across = float((sheet / page).min()), float((sheet[::-1] / page).min())
    return min(1.0, CLEARANCE * max(upright, across))
