"""The report of a run, for people and machines; the same input gives the same bytes."""

from typing import Any

from popsim import __version__, wording
from popsim.pipeline.folder import REPORT_FORMAT
from popsim.pipeline.planned import Planned
from popsim.pipeline.run import DesignRun


def report_of(run: DesignRun, planned: Planned | None, files: list[str], command: str) -> dict[str, Any]:
    """The report as plain data.

    `planned` is None where nothing was exported; `files` are what was made, relative to the report's folder.
    """
    prepared, fit = run.prepared, run.fit
    return {
        "format": REPORT_FORMAT,
        "version": 1,
        "popsim": __version__,
        "command": command,
        "files": files,
        "seed": run.settings.seed,
        "source": {"file": prepared.model.path.name, "sha256": prepared.model.sha256},
        "passed": run.verdict.passed,
        "alignment": {
            "axes": list(prepared.alignment.axes),
            "fold": prepared.alignment.fold,
            "confidence": _rounded(prepared.alignment.up.confidence),
            "heading_confidence": _rounded(prepared.alignment.heading_confidence),
            "front_confidence": _rounded(prepared.alignment.front_confidence),
            "symmetry": _rounded(prepared.alignment.symmetry.score),
            "symmetry_centred": prepared.alignment.symmetry.centred,
            "reasons": list(prepared.alignment.reasons),
        },
        "size": {"longest_mm": _rounded(prepared.longest), "unit_mm": prepared.model.unit},
        "fit": {
            "silhouette": _rounded(fit.likeness.silhouette),
            "relief": _rounded(fit.likeness.relief),
            "begun": fit.begun,
            "kept": [mechanism.id for mechanism in run.settings.fit.wishes.kept],
            "forbidden": sorted(run.settings.fit.wishes.forbidden),
            "placements": [
                {
                    "mechanism": placement.mechanism.id,
                    "type": placement.mechanism.type,
                    "base": list(placement.mechanism.pair.patches),
                    "primitive": placement.primitive.kind,
                    "error_cover": _rounded(placement.error_cover),
                    "alternatives": [
                        {"type": kind, "error_cover": _rounded(error)} for kind, error in placement.alternatives
                    ],
                }
                for placement in fit.placements
            ],
        },
        "patches": {
            "count": len(run.design.popup_patches),
            "renderer": run.painted.renderer,
            "cut_length_mm": _rounded(run.painted.cut_length),
            "vertices": run.painted.vertices,
        },
        "layout": None if planned is None else _layout(planned),
        "assembly": None if planned is None else _assembly(planned),
        "verification": run.verdict.to_dict(),
        "doubts": list(run.doubts),
        "notes": [*run.notes, *(planned.notes if planned else ())],
    }


def _layout(planned: Planned) -> dict[str, Any]:
    layout, contacts = planned.layout, planned.contacts
    in_the_way = None if contacts is None else len({contact.flap.joint.id for contact in contacts})
    return {
        "paper": layout.paper.name,
        "sheets": layout.sheet_count,
        "pieces": len(layout.pieces),
        "flaps": len(layout.flaps),
        "divided": layout.divided,
        "flaps_in_the_way": in_the_way,
    }


def _assembly(planned: Planned) -> dict[str, Any]:
    plan = planned.plan
    return {
        "ease": plan.ease.to_dict(),
        "folds_flat_after_each_step": wording.FOLDS_FLAT,
        "steps": [
            {"number": step.number, "joints": list(step.joints), **step.evidence.to_dict()}
            for step in plan.steps
            if step.evidence is not None
        ],
    }


def _rounded(value: float) -> float:
    """Six decimals: what is worth reading, and the same on every machine."""
    return round(float(value), 6)
