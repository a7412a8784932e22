"""The seven stages, one after another."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from popsim.design import Design
from popsim.fitting import Fit
from popsim.patches import Painted
from popsim.patches.popup_surface import popup_surface
from popsim.pipeline.abstract import abstract_best
from popsim.pipeline.prepare import Prepared, prepare, prepare_ways
from popsim.pipeline.review import bare_sides, doubts, leftovers, overhang
from popsim.pipeline.settings import RunSettings
from popsim.pipeline.sizing import sized
from popsim.verification import Verdict, verify

Progress = Callable[[str], None]
"""Called with the name of each stage as it starts."""


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
    doubts:
        Why it may not be what the user had in mind, one sentence each; empty where nothing speaks for it.
    """

    settings: RunSettings
    prepared: Prepared
    fit: Fit
    painted: Painted
    design: Design
    verdict: Verdict
    notes: tuple[str, ...]
    doubts: tuple[str, ...]


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
    standing = path, settings.stance, settings.size, settings.seed
    ways = (prepare(*standing),) if settings.fit.wishes.placed else prepare_ways(*standing)
    progress("fitting prisms")
    prepared, fit = abstract_best(ways, settings.fit, settings.seed)
    progress("cutting patches")
    painter, design, notes = sized(prepared, fit, settings, path)
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
    if settings.wishes_for not in (None, prepared.model.sha256):
        notes.append("the wishes were written for another model, or for another version of this one")
    doubtful = doubts(prepared.surface, prepared.alignment, fit.likeness)
    paper = popup_surface(_plain(design), {}, pages=False)
    notes += overhang(prepared.scene, prepared.bounds, fit.mechanisms)
    notes += leftovers(prepared.scene, paper, prepared.longest)
    notes += bare_sides(painted.fins, settings.patches.reverse)
    notes += settings.fit.wishes.unmet(fit.mechanisms)
    return DesignRun(settings, prepared, fit, painted, design, verdict, tuple(notes), doubtful)


def _plain(design: Design) -> Design:
    """The design without its prints."""
    bare = [patch.model_copy(update={"texture": None, "texture_frame": None}) for patch in design.patches]
    return design.model_copy(update={"patches": tuple(bare)})
