"""The verdict as a table on the terminal."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table

    from popsim.simulation.physical import PaperRun
    from popsim.verification import Verdict
    from popsim.verification.verdict import Measure


def print_verdict(verdict: "Verdict", name: str) -> None:
    """Print table, notes and the one line that counts."""
    from rich import box
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    console = Console(highlight=False)
    table = Table("", "theory", "simulation", "measured", box=box.SIMPLE_HEAD, pad_edge=False)
    for row in verdict.rows():
        told = f"{row['measured']} (at most {row['tolerance']})" if row["measured"] else ""
        table.add_row(
            row["aspect"],
            f"{_coloured(row['theory'])} {row['margin']}".strip(),
            _coloured(row["simulation"]) + (f" ({_coloured(row['disagreement'])})" if row["disagreement"] else ""),
            escape(", ".join(part for part in (told, row["where"]) if part)),
        )
        for measure in _others(verdict, row["aspect"]):
            place = f", {measure.where}" if measure.where else ""
            told = f"{measure.name} {measure.found} (at most {measure.allowed}){place}"
            table.add_row("", "", "", f"[dim]{escape(told)}[/]")
    console.print(table)
    for name_of, (measured, stated) in verdict.ranges.items():
        theory = "" if stated is None else f", by the theory {stated[0]:.3f} to {stated[1]:.3f}"
        console.print(
            f"closing range of {name_of}: x {measured[0]:.3f} to {measured[1]:.3f} mm{theory}", markup=False
        )
    if verdict.paper is not None:
        console.print(_paper(verdict.paper))
    for note in verdict.notes:
        console.print(f"note: {note}", markup=False)
    word = "[bold green]PASSED[/]" if verdict.passed else "[bold red]FAILED[/]"
    console.print(f"{word} {name}: {_because(verdict)}")


def _paper(run: "PaperRun") -> "Table":
    """What was measured on paper."""
    from rich import box
    from rich.markup import escape
    from rich.table import Table

    from popsim.verification.paper_report import paper_rows

    table = Table("as paper", "measured", box=box.SIMPLE_HEAD, pad_edge=False)
    for name, told in paper_rows(run):
        table.add_row(escape(name), escape(told))
    return table


def _others(verdict: "Verdict", aspect: str) -> list["Measure"]:
    """What else was measured of an aspect, beside the measure its row tells."""
    found = [finding for finding in verdict.findings if finding.aspect == aspect]
    return [measure for finding in found for measure in finding.measures if measure is not finding.worst]


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
