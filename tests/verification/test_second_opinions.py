"""Simulation, closed forms and two oracles that share no code with them say the same of random nested designs."""

import numpy as np
import pytest
from oracles.chain import Chain
from oracles.crossing import crossings

from popsim.design import Design
from popsim.geometry.rigid import transform
from popsim.simulation.folding import fold_design
from popsim.simulation.sweep import Sweep
from popsim.validity import examine
from popsim.verification import verify
from popsim.verification.random_designs import FLAWS, random_design

DEGREES = (178.0, 150.0, 120.0, 90.0, 60.0, 30.0, 10.0, 2.0)
THETA = np.radians(DEGREES)

POSE = 0.001
"""mm; what the simulation promises between 179 and 1 degree."""

EXACT = 1e-7
"""mm; two closed solutions of coordinates that are written with nine decimals."""

SEEN = 0.3
"""mm; a crossing deeper than this cannot hide between two recorded angles or in the thickness of a plate."""


def largest_difference(design: Design, first: dict, second: dict) -> float:
    return max(
        float(np.abs(transform(first[p.id], p.points) - transform(second[p.id], p.points)).max())
        for p in design.patches
    )


def closing(sweep: Sweep) -> dict[int, int]:
    """Position in the sweep of each recorded whole degree on the way down."""
    return {round(degree): k for k, degree in enumerate(sweep.degrees[: sweep.closed + 1])}


@pytest.mark.parametrize("seed", range(4))
def test_closed_chain_agrees_with_closed_forms(seed: int) -> None:
    design = random_design(seed, mechanisms=(2, 6)).design
    folded, known = Chain(design).fold(THETA), examine(design).poses(THETA)
    for k, (poses, gap, free) in enumerate(folded):
        assert gap < EXACT
        assert free == 0
        assert largest_difference(design, poses, {name: motion[k] for name, motion in known.items()}) < EXACT


@pytest.mark.parametrize("seed", range(20, 23))
def test_closed_chain_agrees_with_the_simulation(seed: int) -> None:
    design = random_design(seed, mechanisms=(2, 6)).design
    sweep = fold_design(design, 180).sweep
    frames = closing(sweep)
    for degree, (poses, _, _) in zip(DEGREES, Chain(design).fold(THETA), strict=True):
        simulated = {name: sweep.poses[frames[int(degree)], place] for name, place in sweep.index.items()}
        assert largest_difference(design, poses, simulated) < POSE


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("flaw", [None, *(name for name, flaw in FLAWS.items() if flaw.aspect == "clear")])
def test_simulation_sees_the_crossings_that_are_there(flaw: str | None, seed: int) -> None:
    design = random_design(seed, mechanisms=(1, 4), breaking=flaw).design
    verdict = verify(design)
    sweep = verdict.evidence.sweep
    down = range(5, sweep.closed, 12)
    poses = {name: sweep.poses[down, place] for name, place in sweep.index.items()}
    exact = list(crossings(design, poses, sweep.theta[down]))
    if max((crossing.depth for crossing in exact), default=0.0) > SEEN:
        assert verdict.finding("clear").simulation is False
    if verdict.finding("clear").simulation is False:
        assert exact
    assert bool(exact) is (flaw is not None)


@pytest.mark.parametrize("seed", range(2))
def test_free_motions_are_counted_alike(seed: int) -> None:
    design = random_design(seed, mechanisms=(1, 4), breaking="shear").design
    counted = {free for _, _, free in Chain(design).fold(np.radians([150.0, 90.0, 30.0]))}
    assert counted == {verify(design).evidence.free_count} == {1}
