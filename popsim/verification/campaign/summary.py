"""A campaign in words: the tables that the command prints, made of its report."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

WORDS = {True: "passes", False: "refuses", None: "-"}
"""Verdicts; "-" where there is none, because an aspect that it rests on was refused."""


def summary(report: Mapping[str, Any]) -> str:
    """Text of :meth:`popsim.verification.campaign.Campaign.to_dict`, or of the file that holds it."""
    return "\n".join(line.rstrip() for line in _lines(report)) + "\n"


def _lines(report: Mapping[str, Any]) -> Iterator[str]:
    matrices = [
        (aspect, WORDS[cell["theory"]], WORDS[cell["simulation"]], cell["designs"])
        for aspect, cells in report["matrices"].items()
        for cell in cells
    ]
    yield from _table(("aspect", "theory", "simulation", "designs"), matrices)
    reasons = [
        (flaw, reason or "not refused", count)
        for flaw, counted in sorted(report["refusals"].items())
        for reason, count in counted.items()
    ]
    yield from _table(("planted flaw", "refused because of", "designs"), reasons)
    residuals = [
        (name, f"{found['value']:.3g}", found["design"]) for name, found in sorted(report["residuals"].items())
    ]
    yield from _table(("largest over the valid designs", "value", "design"), residuals)
    for each in report["disagreements"]:
        where = "" if each["file"] is None else f" ({each['file']})"
        yield f"design {each['design']}: {each['kind']} of {each['subject']}: {each['text']}{where}"
    yield _verdict(report)


def _verdict(report: Mapping[str, Any]) -> str:
    """The line that counts."""
    kinds = [each["kind"] for each in report["disagreements"]]
    size = f"{report['designs']} designs, {report['mechanisms']} mechanisms, {report['patches']} patches"
    found = f"{len(kinds) - kinds.count('slack')} disagreements, {kinds.count('slack')} with slack"
    word = "PASSED" if report["passed"] else "FAILED"
    return f"{word} {size}, seed {report['seed']}, popsim {report['popsim']}: {found}"


def _table(heads: Sequence[str], rows: Sequence[Sequence[object]]) -> Iterator[str]:
    """Columns under their heads, the last one aligned to the right, and an empty line."""
    cells = [list(heads), *([str(value) for value in row] for row in rows)]
    widths = [max(len(row[k]) for row in cells) for k in range(len(heads))]
    lines = []
    for row in cells:
        *left, last = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        lines.append("  ".join([*left, last.strip().rjust(widths[-1])]))
    yield from (lines[0], "-" * len(lines[0]), *lines[1:], "")
