"""The verdict as a table on the terminal."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from popsim.verification import Verdict


def print_verdict(verdict: "Verdict", name: str) -> None:
    """Print table, notes and the one line that counts."""
    from rich import box
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    console = Console(highlight=False)
    table = Table("", "theory", "simulation", "measured", box=box.SIMPLE_HEAD, pad_edge=False)
    for row in verdict.rows():
        where = f", {row['where']}" if row["where"] else ""
        table.add_row(
            row["aspect"],
            f"{_coloured(row['theory'])} {row['margin']}".strip(),
            _coloured(row["simulation"]) + (f" ({_coloured(row['disagreement'])})" if row["disagreement"] else ""),
            f"{escape(row['measured'])} (at most {row['tolerance']}){escape(where)}",
        )
    console.print(table)
    for note in verdict.notes:
        console.print(f"note: {note}", markup=False)
    word = "[bold green]PASSED[/]" if verdict.passed else "[bold red]FAILED[/]"
    console.print(f"{word} {name}: {_because(verdict)}")


def _because(verdict: "Verdict") -> str:
    if verdict.passed:
        return f"it folds flat, stands, stays clear and closes; loops are {verdict.grade}"
    failed = [finding.aspect for finding in verdict.findings if not finding.simulation]
    reasons = [f"not {aspect}" for aspect in failed]
    if verdict.holes:
        reasons.append(f"theory and simulation contradict each other on {', '.join(verdict.holes)}")
    return "; ".join(reasons)


def _coloured(text: str) -> str:
    from rich.markup import escape

    good, bad = ("pass", "agrees"), ("fail", "differs", "hole")
    shade = "green" if text in good else "red" if text in bad else "yellow" if text == "slack" else ""
    return f"[{shade}]{escape(text)}[/]" if shade else escape(text)
