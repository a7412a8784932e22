"""What a design does on paper, as a table, as JSON and as CSV."""

import csv
import io
from typing import Any

import numpy as np

from popsim.simulation.physical import PaperRun
from popsim.simulation.physical.paper import Torque
from popsim.stock import CreaseAdvice
from popsim.verification.numbers import number, numbers

COLUMNS = ("fold angle deg", "closing torque N mm", "by energy N mm", "unbalanced N mm", "narrowest gap mm")
"""Of the CSV, one row per measured angle from open to closed."""

EARLY_DEGREES = 5.0
"""Plates that touch at a greater fold angle are told of: a pop-up of 30 mm half width closes its gaps at 1."""

ADVICE: dict[CreaseAdvice, str] = {
    "fold": "fold it plainly",
    "score": "score its folds",
    "perforate": "perforate its folds",
}
"""In words."""


def paper_rows(run: PaperRun) -> list[tuple[str, str]]:
    """What was measured and how much, in words."""
    stock, stack = run.stock, run.stack
    sag = run.sags[0] if run.sags else None
    touch = run.clearance.touches[0] if run.clearance.touches else None
    x, away = stack.place
    return [
        (
            f"paper {stock.name}",
            f"{stock.thickness:.3g} mm thick, bending stiffness {stock.bending:.3g} N mm, creases "
            f"{stock.crease:.3g} N mm/rad per mm; {ADVICE[stock.crease_advice]}",
        ),
        ("weight", f"{run.weight:.3g} N, of pages and pop-up"),
        ("central fold", _turning(run.torque)),
        (
            "closed stack",
            f"{stack.height:.3g} mm, {len(stack.patches)} layers at x {x:.4g} mm, {away:.4g} mm from the fold",
        ),
        ("sag when open", "nothing lies" if sag is None else f"{sag.depth:.2g} mm, {sag.patch}"),
        (
            "thick plates",
            "touch nowhere before the card is closed"
            if touch is None
            else f"first touch at {np.degrees(touch.theta):.3g} deg, {' and '.join(touch.patches)}",
        ),
    ]


def paper_notes(run: PaperRun) -> list[str]:
    """Sentences on gaps that thickness closes early."""
    early = [touch for touch in run.clearance.touches if np.degrees(touch.theta) > EARLY_DEGREES]
    if not early:
        return []
    first = early[0]
    others = f", and so do {len(early) - 1} other pairs above {EARLY_DEGREES:g} deg" if len(early) > 1 else ""
    return [
        f"{run.stock.thickness:.3g} mm thick, {' and '.join(first.patches)} touch at "
        f"{np.degrees(first.theta):.3g} deg{others}: take thinner paper, or leave more room between them"
    ]


def paper_dict(run: PaperRun) -> dict[str, Any]:
    """The run as plain data; angles in degrees, lengths in mm, forces in N."""
    stock, torque, gaps = run.stock, run.torque, run.clearance
    return {
        "stock": {
            "name": stock.name,
            "grammage": number(stock.grammage),
            "thickness": number(stock.thickness),
            "bending": number(stock.bending),
            "crease": number(stock.crease),
            "advice": stock.crease_advice,
        },
        "weight": number(run.weight),
        "torque": {
            "deg": numbers(np.degrees(torque.theta)),
            "closing": numbers(torque.torque),
            "by_energy": numbers(torque.by_energy),
            "rest_deg": [number(np.degrees(angle)) for angle in torque.rests],
            "disagreement": number(torque.disagreement),
            "unbalanced": number(torque.unbalanced.max()),
        },
        "stack": {
            "height": number(run.stack.height),
            "layers": len(run.stack.patches),
            "patches": list(run.stack.patches),
            "place": numbers(run.stack.place),
        },
        "sag": [
            {
                "patch": sag.patch,
                "depth": number(sag.depth),
                "span": number(sag.span),
                "load": number(sag.load),
            }
            for sag in run.sags
        ],
        "clearance": {
            "deg": numbers(np.degrees(gaps.theta)),
            "narrowest": numbers(gaps.least),
            "measured_up_to": number(gaps.most),
            "touches": [
                {"patches": list(touch.patches), "deg": number(np.degrees(touch.theta))} for touch in gaps.touches
            ],
        },
    }


def paper_csv(run: PaperRun | None) -> str:
    """The run against the fold angle, as CSV with the header COLUMNS; that alone where nothing was measured."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    if run is None:
        return text.getvalue()
    torque = run.torque
    values = (
        np.degrees(torque.theta), torque.torque, torque.by_energy, torque.unbalanced, run.clearance.least
    )  # fmt: skip
    writer.writerows([number(value) for value in row] for row in zip(*values, strict=True))
    return text.getvalue()


def _turning(torque: Torque) -> str:
    """Torques at both ends, and where the card rests."""
    ends = [
        f"{abs(torque.torque[k]):.3g} N mm to hold it {'open' if torque.torque[k] < 0 else 'down'} at "
        f"{np.degrees(torque.theta[k]):.3g} deg"
        for k in (0, -1)
    ]
    rests = " and ".join(f"{np.degrees(angle):.3g}" for angle in torque.rests)
    return f"{', '.join(ends)}; rests at {rests} deg" if rests else ", ".join(ends)
