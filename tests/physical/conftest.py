"""Designs folded once, and what they do as paper."""

from collections.abc import Callable

import pytest

from popsim.design import Design
from popsim.simulation import fold_design
from popsim.simulation.physical import PaperRun, fold_paper
from popsim.stock import Stock

FoldPaper = Callable[[Design, Stock], PaperRun]


@pytest.fixture(scope="session")
def on_paper() -> FoldPaper:
    """Fold a design of some stock; the rigid folding is kept by the design's identity."""
    kept: dict[int, tuple[Design, object]] = {}

    def fold(design: Design, stock: Stock) -> PaperRun:
        if id(design) not in kept:
            kept[id(design)] = (design, fold_design(design, 180))
        folding = kept[id(design)][1]
        return fold_paper(folding.rig, folding.sweep, stock)

    return fold
