"""Tables of what the benchmarks found, printed at the end: ratios and exponents count, times are one machine's."""

import os
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

Report = Callable[[str, Sequence[str], Sequence[Sequence[object]]], None]

TABLES = pytest.StashKey[list[str]]()


@pytest.fixture(scope="session")
def compiled(models: Path) -> None:
    """All compiled code of fitting is loaded: a small model was fitted before."""
    from popsim.fitting import FitSettings
    from popsim.pipeline.abstract import abstract
    from popsim.pipeline.prepare import Stance, prepare

    abstract(prepare(models / "skewed_cube" / "skewed_cube.off", Stance(), 150.0, 0), FitSettings(), 0)


@pytest.fixture
def report(pytestconfig: pytest.Config) -> Report:
    """Take a title, column heads and rows for the summary."""

    def add(title: str, heads: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
        table = [list(heads), *([_cell(value) for value in row] for row in rows)]
        widths = [max(len(row[k]) for row in table) for k in range(len(heads))]
        lines = ["  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True)) for row in table]
        pytestconfig.stash.setdefault(TABLES, []).append("\n".join([title, *lines]))

    return add


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Print the tables."""
    for table in config.stash.get(TABLES, []):
        terminalreporter.write_line("\n" + table)


def cpu_seconds(work: Callable[[], object], rounds: int = 3) -> float:
    """Least processor time of some rounds, s, with that of processes they started: other programs do not count."""
    times = []
    for _ in range(rounds):
        start = _processor_time()
        work()
        times.append(_processor_time() - start)
    return min(times)


def _processor_time() -> float:
    spent = os.times()
    return spent.user + spent.system + spent.children_user + spent.children_system


def exponent(sizes: Sequence[float], costs: Sequence[float]) -> float:
    """Power with which the costs grow with the sizes, by least squares of the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(costs), 1)[0])


def _cell(value: object) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)
