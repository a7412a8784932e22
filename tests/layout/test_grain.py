"""With grain, the paper's grain runs one way through the whole model: along the central fold."""

import numpy as np
import pytest
from shapely.geometry import box as rectangle

from popsim.design import Card, Design
from popsim.geometry.flat import move_shape
from popsim.layout import Layout, LayoutSettings, lay_out
from popsim.layout.parts import ACROSS, FOLD
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.verification.random_designs import random_design

GRAIN = LayoutSettings(grain=True)
LEVEL = np.radians(1)


def off_grain(layout: Layout) -> dict[str, float]:
    """Angle between the sheet's longer side and the fold as each part sees it that is not square to it."""
    found = {}
    side = np.array([0.0, 1.0]) if layout.paper.height >= layout.paper.width else np.array([1.0, 0.0])
    for placement in layout.placements:
        for name, motion in placement.piece.motions.items():
            plane = layout.parts[name].plane
            seen = np.array([FOLD @ plane.u, FOLD @ plane.v])
            if np.linalg.norm(seen) >= ACROSS:
                turned = (placement.motion @ motion)[:2, :2] @ seen / np.linalg.norm(seen)
                found[name] = float(np.arccos(np.clip(abs(turned @ side), 0, 1)))
    return found


def design(*boxes: tuple[float, float, float, float]) -> Design:
    """Box-folds side by side on one card: half width, height, and where they begin and end."""
    card = Card(x=(-90, 90), depth=70)
    made = [
        BoxFold.plain(f"M{k}", card_pair(card), half, height, (low, high))
        for k, (half, height, low, high) in enumerate(boxes, 1)
    ]
    return assemble(card, made)


@pytest.mark.parametrize("paper", ["A4", "A3", "Letter", "297x210mm"])
def test_the_grain_runs_along_the_fold_in_every_part(paper: str) -> None:
    made = design((20, 30, -80, -10), (15, 25, 10, 60))
    off = off_grain(lay_out(made, paper=paper, settings=GRAIN))
    assert len(off) >= 6
    assert max(off.values()) < LEVEL


@pytest.mark.parametrize("seed", range(6))
def test_all_pieces_of_random_designs_follow_the_grain_with_most_of_their_paper(seed: int) -> None:
    layout = lay_out(random_design(seed, mechanisms=(1, 4)).design, settings=GRAIN)
    off = off_grain(layout)
    for placement in layout.placements:
        areas = {name: layout.parts[name].polygon.area for name in placement.piece.motions if name in off}
        if len(areas) == len(placement.piece.motions):
            along = sum(area for name, area in areas.items() if off[name] < LEVEL)
            assert along > 0 and (len(areas) > 1 or along == sum(areas.values()))


def test_without_grain_pieces_are_turned() -> None:
    """Negative control."""
    made = design((20, 30, -80, -10), (15, 25, 10, 60))
    assert max(off_grain(lay_out(made)).values()) > 1


def test_pieces_stay_within_the_margins() -> None:
    made = design((20, 30, -80, -10))
    layout = lay_out(made, settings=GRAIN)
    page = rectangle(0, 0, 210, 297)
    for placement in layout.placements:
        assert page.contains(move_shape(placement.motion, placement.piece.outline))
