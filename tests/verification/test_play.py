"""Play: how much, where, and how to need less."""

import json

import numpy as np
import pytest
from folding_designs import CARD, CARD_PAIR, mismatched_box, plain_box, slanted_box
from scipy.optimize import brentq, minimize_scalar

from popsim.geometry.rigid import transform
from popsim.mechanisms import assemble
from popsim.mechanisms.box_fold import BoxFold
from popsim.simulation import fold_design
from popsim.verification import Settings, verify
from popsim.verification.random_designs.spoil import spoil

COARSE = Settings(angles=90)


def ridge_gap(slant: float, half: float = 30.0, height: float = 40.0) -> float:
    """Greatest gap of a front pair whose ridge alone opens; sides lean inward by `slant`, with b + r = c + t_b.

    The cross-section is a planar four-bar linkage that closes exactly. A front patch turns about the side's edge;
    its mirror image about the other. Their ridges are apart by twice their distance from the mirror plane.
    """
    side = np.hypot(height, slant)
    backbone = brentq(lambda c: c + np.hypot(half - slant, height - c) - half - side, 0, half + side)
    top = np.hypot(half - slant, height - backbone)
    along = np.array([-slant, height]) / side
    ends = np.array([[-half, 0.0], [-half, height]])
    rises, reaches = ends @ along, np.abs(ends @ [along[1], -along[0]])

    def smallest(theta: float) -> float:
        foot = half * np.array([np.sin(theta / 2), np.cos(theta / 2)])
        span = np.array([0.0, backbone]) - foot
        far = np.linalg.norm(span)
        near = (far**2 + side**2 - top**2) / (2 * far)
        out = np.array([span[1], -span[0]]) / far * np.sqrt(max(side**2 - near**2, 0.0))
        edge = (near * span / far + out) / side
        inward = np.array([-edge[1], edge[0]])

        def gap(turn: float) -> float:
            return float(2 * np.abs(foot[0] + rises * edge[0] + reaches * np.cos(turn) * inward[0]).max())

        rough = min(np.linspace(0, np.pi / 2, 400), key=gap)
        return float(minimize_scalar(gap, bounds=(rough - 0.01, rough + 0.01), method="bounded").fun)

    return max(smallest(theta) for theta in np.radians(np.arange(60, 150, 2)))


def shared_gap(slant: float, degrees: float) -> float:
    """Greatest gap at a fold angle where every hinge may open: the least sum of squares of all gaps."""
    design = slanted_box(slant)
    sweep = fold_design(design, 90).sweep
    (frame,) = sweep.closing_at([degrees])
    hinges = [hinge for hinge in design.hinges if hinge.kind != "central"]
    place = {patch.id: 6 * index for index, patch in enumerate(design.popup_patches)}
    ends = [[transform(sweep.poses[frame, sweep.index[name]], h.points) for name in h.patches] for h in hinges]

    def moved(values: np.ndarray, name: str, points: np.ndarray) -> np.ndarray:
        if name not in place:
            return points
        at = place[name]
        return points + np.cross(values[at : at + 3] / 30, points) + values[at + 3 : at + 6]

    def gaps(values: np.ndarray) -> np.ndarray:
        pairs = zip(hinges, ends, strict=True)
        sides = [[moved(values, *side) for side in zip(h.patches, both, strict=True)] for h, both in pairs]
        return np.concatenate([(one - other).ravel() for one, other in sides])

    start = gaps(np.zeros(6 * len(place)))
    matrix = np.stack([gaps(unit) - start for unit in np.eye(6 * len(place))], axis=1)
    left = gaps(np.linalg.lstsq(matrix, -start, rcond=None)[0])
    return float(np.linalg.norm(left.reshape(-1, 3), axis=1).max())


@pytest.mark.parametrize(("slant", "shared"), [(1, 0.052), (2, 0.108), (-1, 0.048)])
def test_play_shared_evenly_by_all_hinges_is_as_documented(slant, shared):
    assert shared_gap(slant, 96) == pytest.approx(shared, rel=0.05)


@pytest.mark.parametrize(
    ("slant", "ridge", "reported"), [(1, 0.31, 0.19), (4, 1.39, 0.89), (-1, 0.29, 0.18), (-8, 1.87, 1.08)]
)
def test_play_of_slanted_sides_is_as_documented(slant, ridge, reported):
    """If the ridge alone gives way, in closed form, and as the simulation shares it among the loop hinges."""
    assert ridge_gap(slant) == pytest.approx(ridge, abs=0.006)
    assert verify(slanted_box(slant), COARSE).play.needed == pytest.approx(reported, abs=0.006)


def test_slanted_edges_joined_along_less_of_their_length_need_less():
    """Leaning out by 4 mm: 0.63 mm joined all along, 0.25 mm along the lowest 10 of 40 mm."""
    verdict = verify(slanted_box(-4), COARSE)
    assert verdict.grade == "refused"
    play = verdict.play
    assert play.needed == pytest.approx(0.626, abs=0.005)
    assert play.shortened == pytest.approx(0.245, abs=0.005)
    hinges = {hinge.id: set(hinge.patches) for hinge in slanted_box(-4).hinges}
    assert sorted(sorted(hinges[name]) for name in play.slanted) == [
        ["M.B_L", "M.L"], ["M.B_R", "M.R"], ["M.F_L", "M.L"], ["M.F_R", "M.R"]
    ]  # fmt: skip
    (note,) = [note for note in verdict.notes if "play" in note]
    assert f"hinge {play.hinge}" in note and "lowest 25% of their length only it needs 0.25 mm" in note
    told = json.loads(verdict.to_json())["play"]
    assert told["slanted"] == list(play.slanted) and told["kept"] == 0.25


def test_lengths_that_miss_by_a_tenth_pass_within_play_and_no_edge_is_blamed():
    """The backbone is 0.1 mm too long for b + r = c + t_b."""
    verdict = verify(mismatched_box(0.1), COARSE)
    assert verdict.grade == "within play"
    assert verdict.finding("foldable").simulation is True
    assert verdict.play.slanted == () and verdict.play.shortened is None
    assert verdict.play.needed == pytest.approx(0.1, abs=0.001)
    (note,) = [note for note in verdict.notes if "play" in note]
    assert "lengths around it do not add up" in note and "slant" not in note


@pytest.mark.parametrize("excess", [-0.1, -0.05, 0.02, 0.15])
def test_parallel_sides_need_as_much_play_as_they_miss_the_condition_by(excess):
    """Sec. 3.3.1: all of it at the closed card, where everything has to lie in one plane."""
    verdict = verify(mismatched_box(excess), COARSE)
    assert verdict.play.needed == pytest.approx(abs(excess), rel=0.02)
    assert np.degrees(verdict.play.theta) < 2


def test_a_backbone_that_is_too_long_buckles_by_the_root_of_it_near_the_closed_card():
    """Plates that do not push each other are told to cross there: refused on the safe side."""
    box = BoxFold.plain("M", CARD_PAIR, 40, 20, (-40, 40))
    (ridge,) = box.faults()
    depth = {}
    for excess in (0.05, 0.2):
        verdict = verify(spoil(assemble(CARD, [box]), box, ridge, -excess), COARSE)
        assert verdict.finding("foldable").simulation and not verdict.passed
        depth[excess] = verdict.finding("clear").worst.value
        assert verdict.evidence.contacts[0].first < np.radians(10)
    assert depth[0.2] / depth[0.05] == pytest.approx(2, rel=0.4)


def test_what_folds_rigidly_needs_no_play():
    verdict = verify(plain_box(), COARSE)
    assert verdict.grade == "rigid" and verdict.play is None
    assert json.loads(verdict.to_json())["play"] is None


def test_what_tears_by_far_gets_no_remedy():
    verdict = verify(mismatched_box(5), COARSE)
    assert verdict.play is None or verdict.play.shortened is None
    assert not any("joined along" in note for note in verdict.notes)
