"""The verdict as a table and as JSON."""

import json
from typing import Any

import numpy as np

from popsim import __version__
from popsim.mechanisms import Condition
from popsim.verification.numbers import number, numbers
from popsim.verification.paper_report import paper_dict
from popsim.verification.play import KEPT, Play
from popsim.verification.verdict import Finding, Measure, Verdict


def rows(verdict: Verdict) -> list[dict[str, str]]:
    """One row per aspect and per comparison with the closed forms."""
    compared = [
        {
            "aspect": measure.name,
            "condition": "closed form",
            "margin": "",
            "measured": measure.found,
            "tolerance": measure.allowed,
            "where": measure.where,
            "theory": "",
            "simulation": "agrees" if measure.holds else "differs",
            "disagreement": "" if measure.holds else "hole",
        }
        for measure in verdict.agreement
    ]
    return [_row(finding) for finding in verdict.findings] + compared


def to_json(verdict: Verdict) -> str:
    """The report as JSON text."""
    return json.dumps(to_dict(verdict), indent=1, allow_nan=False) + "\n"


def to_dict(verdict: Verdict) -> dict[str, Any]:
    """The report as plain data; angles in degrees, lengths in mm."""
    evidence = verdict.evidence
    degrees = np.degrees
    return {
        "format": "popsim-verdict",
        "version": 1,
        "popsim": __version__,
        "passed": verdict.passed,
        "grade": verdict.grade,
        "holes": list(verdict.holes),
        "slack": list(verdict.slack),
        "notes": list(verdict.notes),
        "aspects": [_finding(finding) for finding in verdict.findings],
        "agreement": [_measure(measure) for measure in verdict.agreement],
        "ranges": {
            name: {"measured": numbers(found), "analytic": None if stated is None else numbers(stated)}
            for name, (found, stated) in verdict.ranges.items()
        },
        "contacts": [
            {
                "patches": list(contact.patches),
                "way": contact.way,
                "first_deg": number(degrees(contact.first)),
                "depth": number(contact.depth),
                "deepest_deg": number(degrees(contact.deepest)),
            }
            for contact in evidence.contacts
        ],
        "free_motions": [
            {"deg": number(degrees(motion.theta)), "count": motion.count, "stiffness": number(motion.stiffness)}
            for motion in evidence.free
        ],
        "pushes": [
            {
                "deg": number(degrees(push.theta)),
                "moved": number(push.moved),
                "left": number(push.left),
                "patch": push.patch,
            }
            for push in evidence.pushes
        ],
        "loop_gap": {
            "deg": numbers(evidence.sweep.degrees.tolist()),
            "gap": numbers(evidence.gaps.by_angle.tolist()),
        },
        "play": None if verdict.play is None else _play(verdict.play),
        "paper": None if verdict.paper is None else paper_dict(verdict.paper),
    }


def _finding(finding: Finding) -> dict[str, Any]:
    broken = [condition for condition in finding.conditions or () if not condition.holds]
    return {
        "aspect": finding.aspect,
        "theory": finding.theory,
        "simulation": finding.simulation,
        "disagreement": finding.disagreement,
        "margin": None if finding.tightest is None else number(finding.tightest.margin),
        "tightest": None if finding.tightest is None else _condition(finding.tightest),
        "broken": [_condition(condition) for condition in broken],
        "measures": [_measure(measure) for measure in finding.measures],
        "unjudged": finding.unjudged or None,
    }


def _play(play: Play) -> dict[str, Any]:
    return {
        "needed": number(play.needed),
        "hinge": play.hinge,
        "patches": list(play.patches),
        "deg": number(np.degrees(play.theta)),
        "slanted": list(play.slanted),
        "kept": KEPT if play.shortened is not None else None,
        "shortened": None if play.shortened is None else number(play.shortened),
    }


def _condition(condition: Condition) -> dict[str, Any]:
    return {"subject": condition.subject, "name": condition.name, "margin": number(condition.margin)}


def _measure(measure: Measure) -> dict[str, Any]:
    return {
        "name": measure.name,
        "value": number(measure.value),
        "tolerance": number(measure.tolerance),
        "unit": measure.unit,
        "holds": measure.holds,
        "where": measure.where,
    }


def _row(finding: Finding) -> dict[str, str]:
    worst, tightest = finding.worst, finding.tightest
    return {
        "aspect": finding.aspect,
        "condition": "" if tightest is None else f"{tightest.subject}: {tightest.name}",
        "margin": "" if tightest is None else f"{tightest.margin:.4g} mm",
        "measured": "" if worst is None else f"{worst.name} {worst.found}",
        "tolerance": "" if worst is None else worst.allowed,
        "where": finding.unjudged if worst is None else worst.where,
        "theory": _word(finding.theory),
        "simulation": _word(finding.simulation),
        "disagreement": finding.disagreement or "",
    }


def _word(holds: bool | None) -> str:
    return {True: "pass", False: "refuse", None: "-"}[holds]
