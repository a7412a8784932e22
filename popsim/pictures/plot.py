"""What was measured against the fold angle, in one figure."""

from pathlib import Path

import numpy as np

from popsim.design import Design
from popsim.errors import InputError
from popsim.files import write_file, write_text
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.pictures.canvas import to_image, to_svg
from popsim.pictures.chart import Curve, Panel, draw, size_of
from popsim.simulation.physical import PaperRun
from popsim.simulation.stability import SINGULAR
from popsim.simulation.sweep import Sweep
from popsim.validity import examine
from popsim.verification import Settings, Verdict
from popsim.verification.agreement import distances

CLOSING, OPENING = "#1d5f8a", "#e08a2e"
"""Colours of the two ways."""

PAIRS = ("#7b2cbf", "#2a9d8f", "#b5651d", "#5c677d", "#d81b60")
"""Colours of patches that cross, the deepest first; the others are not drawn."""

SUFFIXES = (".png", ".svg")
"""What can be written."""


def check_plot(path: Path) -> None:
    """Raise InputError where `path` has no suffix that :func:`write_plot` knows."""
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(f"a plot is written as {' or '.join(SUFFIXES)}, not {path.suffix or 'without a suffix'}")


def write_plot(path: Path, design: Design, verdict: Verdict, title: str, *, force: bool) -> None:
    """Draw loop gap, free motions, stiffness, distance from closed forms, crossings; of paper torque, clearance.

    Parameters
    ----------
    path:
        PNG or SVG to write.
    design, verdict:
        What was folded and found, with the tolerances of :class:`popsim.verification.Settings`.
    title:
        What stands above the figure.
    force:
        Overwrite an existing file.

    Raises
    ------
    InputError
        The suffix is neither .png nor .svg.
    OutputError
        The file exists and `force` is false, or cannot be written.
    """
    check_plot(path)
    settings = Settings()
    panels = [
        _gaps(verdict, settings),
        _free_motions(verdict),
        _stiffness(verdict),
        _closed_forms(design, verdict, settings),
        _crossings(verdict, settings),
        *(() if verdict.paper is None else _paper(verdict.paper)),
    ]
    keys = [("closing", CLOSING, False), ("opening", OPENING, True)]
    shapes, size = draw(f"{title}: {'passed' if verdict.passed else 'failed'}", keys, panels), size_of(panels)
    if path.suffix.lower() == ".svg":
        write_text(path, to_svg(shapes, size), force=force)
    else:
        image = to_image(shapes, size)
        write_file(path, lambda temporary: image.save(temporary, format="PNG"), force=force)


def _both_ways(sweep: Sweep, at: IntArray, values: FloatArray) -> tuple[Curve, ...]:
    """One curve for closing and one for opening, of `values` (k,) at recorded angles `at` (k,)."""
    shut, again = at <= sweep.closed, at >= sweep.closed
    return (
        Curve(sweep.degrees[at[shut]], values[shut], CLOSING),
        Curve(sweep.degrees[at[again]], values[again], OPENING, dashed=True),
    )


def _gaps(verdict: Verdict, settings: Settings) -> Panel:
    evidence = verdict.evidence
    note = "" if evidence.gaps.hinges else "no loops"
    curves = _both_ways(evidence.sweep, np.arange(len(evidence.sweep.theta)), evidence.gaps.by_angle)
    limits = (("rigid", settings.rigid), ("play", settings.play))
    return Panel("largest loop gap, mm", () if note else curves, limits, note=note)


def _free_motions(verdict: Verdict) -> Panel:
    counts = np.array([motion.count for motion in verdict.evidence.free], dtype=float)
    return _at_counted(verdict, "number of free motions", counts, ("stands with", 0.0), logarithmic=False)


def _stiffness(verdict: Verdict) -> Panel:
    values = np.array([motion.stiffness for motion in verdict.evidence.free])
    return _at_counted(
        verdict, "stiffness of the softest motion, mm of gap per mm", values, ("free below", SINGULAR)
    )


def _at_counted(
    verdict: Verdict, title: str, values: FloatArray, limit: tuple[str, float], *, logarithmic: bool = True
) -> Panel:
    """Values (n,) at the angles where free motions were counted."""
    free = verdict.evidence.free
    angles = np.degrees([motion.theta for motion in free])
    note = "" if free else "not measured: the loops do not close"
    return Panel(title, (Curve(angles, values, CLOSING, dotted=True),), (limit,), logarithmic, note)


def _closed_forms(design: Design, verdict: Verdict, settings: Settings) -> Panel:
    title, limits = "largest distance from the closed forms, mm", (("at most", settings.pose),)
    if not verdict.agreement:
        return Panel(title, (), limits, note="not compared: no mechanisms, or they do not fold rigidly")
    at, away = distances(verdict.evidence.sweep, examine(design))
    largest = np.max(list(away.values()), axis=0, initial=0.0)
    return Panel(title, _both_ways(verdict.evidence.sweep, at, largest), limits)


def _crossings(verdict: Verdict, settings: Settings) -> Panel:
    limits = (("at most", settings.crossing),)
    contacts = verdict.evidence.contacts
    judged = verdict.finding("clear").unjudged
    note = f"not judged: {judged}" if judged else "" if contacts else "nothing crosses"
    curves = tuple(
        Curve(
            np.degrees([angle for angle, _ in contact.trace]),
            np.array([depth for _, depth in contact.trace]),
            colour,
        )
        for contact, colour in zip(contacts, PAIRS, strict=False)
    )
    deepest = f"; deepest: {' and '.join(contacts[0].patches)}" if contacts else ""
    return Panel(f"depth of crossings while closing, mm{deepest}", curves, limits, logarithmic=False, note=note)


def _paper(run: PaperRun) -> tuple[Panel, Panel]:
    """Torque at the central fold, and the narrowest gap between thick plates."""
    torque, gaps = run.torque, run.clearance
    turning = Curve(np.degrees(torque.theta), torque.torque, CLOSING)
    narrowest = Curve(np.degrees(gaps.theta), gaps.least, CLOSING)
    return (
        Panel(
            f"torque that holds the card, N mm, towards closing; {run.stock.name}",
            (turning,),
            (("rests by itself", 0.0),),
            logarithmic=False,
        ),
        Panel(
            f"narrowest gap between plates {run.stock.thickness:.3g} mm thick, mm; measured up to {gaps.most:.3g}",
            (narrowest,),
            (("touch", 0.0),),
            logarithmic=False,
        ),
    )
