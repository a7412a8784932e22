"""From evidence to measures with tolerances, aspect by aspect."""

import numpy as np

from popsim.mechanisms.condition import Aspect
from popsim.simulation.contact import Contact
from popsim.verification.evidence import Evidence
from popsim.verification.settings import Settings
from popsim.verification.verdict import Grade, Measure

NO_LOOPS = "the loops do not close, so its poses mean nothing"
LOOSE = "something moves freely, so where it ends up is chance"
JAMMED = "something moves freely, so where it jams is chance"


def judge(evidence: Evidence, settings: Settings, aspect: Aspect) -> tuple[tuple[Measure, ...], str]:
    """Measures of one aspect, and why it could not be judged ("" where it could)."""
    closes = evidence.sweep.complete and evidence.gaps.largest <= settings.play
    jammed = not closes and evidence.free_count > 0
    if aspect == "foldable":
        return ((), JAMMED) if jammed else (_foldable(evidence, settings, closes), "")
    if aspect == "stable" and (closes or jammed):
        return _stable(evidence, settings), ""
    if not closes:
        return (), NO_LOOPS
    if _loose(evidence, settings):
        return (), LOOSE
    return (_clear if aspect == "clear" else _contained)(evidence, settings), ""


def grade(evidence: Evidence, settings: Settings) -> Grade:
    """How much give the loops need."""
    if not evidence.sweep.complete or not evidence.gaps.largest <= settings.play:
        return "refused"
    return "rigid" if evidence.gaps.largest <= settings.rigid else "within play"


def rigid_and_steady(evidence: Evidence, settings: Settings) -> bool:
    """Whether poses are determined, so that closed forms can be compared with them."""
    return grade(evidence, settings) == "rigid" and not _loose(evidence, settings)


def _foldable(evidence: Evidence, settings: Settings, closes: bool) -> tuple[Measure, ...]:
    gaps, worst = evidence.gaps, evidence.gaps.worst
    where = "" if worst is None else f"{' and '.join(worst[0].patches)} at {_degrees(worst[1])}"
    measures = [Measure("loop gap", gaps.largest, settings.play, where=where)]
    if not evidence.sweep.complete:
        stuck = float(evidence.sweep.theta[-1])
        lost = Measure("sweeps that broke down", 1, 0, "", f"after {_degrees(stuck)}: the loops tear")
        return (lost, *measures)
    if closes and not _loose(evidence, settings) and evidence.flat and evidence.reopened:
        flat, back = evidence.flat, evidence.reopened
        measures.append(Measure("height above the closed plane", flat.value, settings.flat, where=flat.patch))
        name = "opened onto another branch" if back.value > settings.reopened else "opened pose off the first"
        measures.append(Measure(name, back.value, settings.reopened, where=back.patch))
    return tuple(measures)


def _stable(evidence: Evidence, settings: Settings) -> tuple[Measure, ...]:
    hardest = max(evidence.pushes, key=lambda push: np.nan_to_num(push.moved, nan=np.inf), default=None)
    measures = []
    if evidence.free:
        loose = sum(motion.count > 0 for motion in evidence.free)
        share = f"{loose} of {len(evidence.free)}" if loose else f"{len(evidence.free)}"
        at = f"{share} angles from {_degrees(evidence.free[0].theta)} to {_degrees(evidence.free[-1].theta)}"
        measures.append(Measure("free motions", evidence.free_count, 0, "", at))
    if hardest is not None:
        where = f"{hardest.patch} at {_degrees(hardest.theta)}"
        limit, left = _push_limit(evidence, settings), max(push.left for push in evidence.pushes)
        measures.append(Measure("motion when pushed", hardest.moved, limit, where=where))
        measures.append(Measure("motion left after release", left, limit))
    return tuple(measures)


def _clear(evidence: Evidence, settings: Settings) -> tuple[Measure, ...]:
    limit = settings.crossing + evidence.gaps.largest
    if not evidence.contacts:
        return (Measure("crossing", 0.0, limit),)
    deepest = evidence.contacts[0]
    return (Measure("crossing", deepest.depth, limit, where=describe(deepest)),)


def _contained(evidence: Evidence, settings: Settings) -> tuple[Measure, ...]:
    out = evidence.protruding
    if out is None:
        return ()
    return (Measure("protrusion", out.value, settings.protruding, where=out.patch if out.value > 0 else ""),)


def describe(contact: Contact) -> str:
    """Pair and angles of a contact in words."""
    first, deepest = _degrees(contact.first), _degrees(contact.deepest)
    again = "" if contact.way == "closing" else ", opening again"
    return f"{' and '.join(contact.patches)} from {first}, deepest at {deepest}{again}"


def _loose(evidence: Evidence, settings: Settings) -> bool:
    limit = _push_limit(evidence, settings)
    return evidence.free_count > 0 or not all(push.moved <= limit for push in evidence.pushes)


def _push_limit(evidence: Evidence, settings: Settings) -> float:
    return settings.pushed * evidence.scale


def _degrees(theta: float) -> str:
    return f"{np.degrees(theta):.4g} deg"
