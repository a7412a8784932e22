"""The verdict as a table on the terminal."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from popsim.verification import Verdict

_COLUMNS = ("aspect", "theory", "margin", "simulation", "measured", "tolerance", "where", "disagreement")


def print_verdict(verdict: "Verdict", name: str) -> None:
    """Print table, notes and the one line that counts."""
    from rich import box
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, soft_wrap=False)
    rows = verdict.rows()
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    shown = [column for column in _COLUMNS if any(row[column] for row in rows)]
    for column in shown:
        table.add_column(column)
    for row in rows:
        table.add_row(*(_coloured(row[column]) for column in shown))
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
