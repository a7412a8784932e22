"""What is half made is folded on its own: laws over steps, and structures that must not fold."""

from functools import cache

import numpy as np
import pytest
from folding_designs import mismatched_box
from hypothesis import given
from hypothesis import strategies as st

from popsim.assembly import AssemblyPlan, plan_assembly
from popsim.assembly.evidence import PLAY, Folded
from popsim.assembly.folding import Folding
from popsim.assembly.kit import Kit
from popsim.assembly.unmaking import find_order
from popsim.design import Card, Design, Hinge, Patch
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform, turns_about
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.simulation import fold_design
from popsim.simulation.partial import Crossings, Structure, fold_partial
from popsim.simulation.partial.hands import led_joints
from popsim.simulation.partial.rig import PartialRig
from popsim.verification.random_designs import random_design

CARD = Card(x=(-80, 80), depth=120)
TIGHT = 1e-3
"""mm; loops of what folds close to this and better."""


@cache
def box() -> Design:
    return assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 20, 30, (-30, 30))])


@cache
def kit() -> Kit:
    return Kit(lay_out(box()), fold_design(box(), 45).sweep)


@cache
def mismatched(wrong: float) -> AssemblyPlan:
    """Plan of a box whose b + r is not c + t_b, by mm."""
    design = mismatched_box(wrong)
    return plan_assembly(lay_out(design), fold_design(design, 45).sweep)


@pytest.mark.parametrize("seed", range(3))
def test_what_is_glued_folds_flat_after_each_step(seed: int) -> None:
    design = random_design(seed, mechanisms=(1, 5)).design
    plan = plan_assembly(lay_out(design), fold_design(design, 45).sweep)
    folds = [step.evidence.folded for step in plan.steps if step.evidence is not None]
    for folded in folds:
        assert folded is not None
        assert folded.gap < TIGHT
        assert folded.thickness < 0.05
        assert folded.crossing < 0.05
        assert folded.led >= 1
    last = folds[-1]
    assert last is not None
    assert last.led == 1, "the finished card is led by its own fold alone"
    assert last.parts == len(plan.layout.parts)


def test_hands_lead_what_is_free_and_ever_less_of_it() -> None:
    """In a box each loop that is closed takes freedom away; nothing that is glued gives any back."""
    folding, order = Folding(kit()), [proof for proof in find_order(kit()).proofs if proof.joints]
    led = [folding.folded(proof).led for proof in order]
    assert max(led) > 1
    assert led[-1] == 1


def moved_hinge(name: str, shift: tuple[float, float, float]) -> Design:
    """The box with one hinge at another place on its second patch: glued where it does not belong."""
    hinges = [
        hinge
        if hinge.id != name
        else hinge.model_copy(update={"axis": tuple(tuple(np.add(end, shift).tolist()) for end in hinge.axis)})
        for hinge in box().hinges
    ]
    return Design(card=CARD, patches=box().patches, hinges=tuple(Hinge(**h.model_dump()) for h in hinges))


def folded(design: Design) -> tuple[float, float]:
    """Gap and thickness of a design that is led as the box moves."""
    structure = Structure.of(design, frozenset(), "G")
    reference = kit().reference
    frames = range(1, len(reference.theta))
    poses = np.stack([reference.poses[patch.id][1:] for patch in design.patches], axis=1)
    assert len(frames) == len(poses)
    found = fold_partial(structure, Crossings(design), reference.theta[1:], poses)
    return found.gap, found.thickness


def test_what_is_glued_to_the_wrong_place_does_not_fold() -> None:
    """Negative control: a side that stands 4 mm beside its place tears its loops; in its place it does not."""
    foot = next(hinge.id for hinge in box().hinges if set(hinge.patches) == {"G", "M1.L"})
    assert max(folded(moved_hinge(foot, (0, 0, 0)))) < 0.01
    assert folded(moved_hinge(foot, (0, 0, 4)))[0] > PLAY


def test_a_box_of_wrong_measures_folds_until_its_loop_is_closed() -> None:
    """Negative control: where b + r is not c + t_b, steps that close a loop are refused, with the reason."""
    plan = mismatched(2.0)
    told = [step.evidence for step in plan.steps if step.evidence is not None]
    assert any(evidence.feasible for evidence in told)
    assert not told[-1].feasible
    assert all("does not fold flat" in evidence.way for evidence in told if not evidence.feasible)
    assert plan.ease.unproved == sum(len(step.joints) for step in plan.unproved)


SQUARE = ("G", "M1.L", "M1.T_G", "M1.C")
"""Half of a box that is as deep as it is high: closed, the top of its backbone meets the foot of its side."""


def test_of_the_ways_that_part_where_all_is_flat_the_flat_one_is_taken() -> None:
    """There top and side turn about one line, however the backbone is led: pressed, they lie down again."""
    design = assemble(CARD, [BoxFold.plain("M1", card_pair(CARD), 30, 30, (-30, 30))])
    sweep = fold_design(design, 45).sweep
    names = {hinge.id for hinge in design.hinges if set(hinge.patches) <= set(SQUARE)}
    rig = PartialRig(Structure.of(design, frozenset(), "G").only(SQUARE, names, "G"))
    place = [sweep.index[patch.id] for patch in rig.structure.design.patches]
    closed = sweep.poses[sweep.closed][place]
    flat = rig.angles(closed[None])[0]
    parts = [set(joint.hinge.patches) for joint in rig.turning]
    side, back = (parts.index({"G", name}) for name in ("M1.L", "M1.C"))
    rig.put(closed[0])
    rig.hold(np.array([back]))

    def height() -> float:
        points = [
            (pose[:3, :3] @ patch.points.T).T + pose[:3, 3]
            for pose, patch in zip(rig.poses(), patches_of(rig), strict=True)
        ]
        return float(np.abs(np.concatenate(points)[:, 1]).max())

    def gap() -> float:
        poses = dict(zip((patch.id for patch in patches_of(rig)), rig.poses(), strict=True))
        ends = [[transform(poses[name], hinge.points) for name in hinge.patches] for hinge in rig.forest.loops]
        return float(max(np.abs(one - other).max() for one, other in ends))

    for turn in (np.radians(8.0), -np.radians(8.0)):
        astray = flat.copy()
        astray[side] += turn
        rig.start(astray)
        rig.polish(flat)
        assert height() > 3.0, "closed loops alone do not tell which way to go on"
        rig.flatten()
        assert height() < 0.01
        assert gap() < 0.01
        rig.hold(np.array([back]))


def patches_of(rig: PartialRig) -> tuple[Patch, ...]:
    return rig.structure.design.patches


def turned_over(axis: FloatArray, degrees: FloatArray) -> FloatArray:
    """Turns about a line (2, 3), shape (n, 4, 4)."""
    along = (axis[1] - axis[0]) / np.linalg.norm(axis[1] - axis[0])
    return turns_about(along, axis[0], np.radians(degrees))


def test_plates_that_run_through_each_other_are_found() -> None:
    """Negative control: the backbone, turned through the side of the box."""
    reference, design = kit().reference, box()
    sweep = fold_design(design, 45).sweep
    crossings = Crossings(design)
    assert crossings.deepest(sweep)[0] < 0.05
    poses = sweep.poses.copy()
    poses[:, sweep.index["M1.C"], 1, 3] += 25.0
    poses[:, sweep.index["M1.C"], :3, :3] = poses[:, sweep.index["M1.L"], :3, :3]
    turn = np.radians(40.0)
    tilt = np.array([[1, 0, 0], [0, np.cos(turn), -np.sin(turn)], [0, np.sin(turn), np.cos(turn)]])
    poses[:, sweep.index["M1.C"], :3, :3] = tilt @ poses[:, sweep.index["M1.C"], :3, :3]
    depth, pair = crossings.deepest(type(sweep)(design, sweep.theta, poses, sweep.states, complete=True))
    assert depth > 1.0
    assert "M1.C" in pair
    assert reference.folds_flat


def test_parts_that_will_meet_on_a_line_cross_where_they_are_off_it() -> None:
    """Negative control: the foot of a side that is not glued yet, pushed 5 mm through the page."""
    sweep = fold_design(box(), 45).sweep
    unglued = tuple(hinge for hinge in box().hinges if set(hinge.patches) != {"G", "M1.L"})
    half = Design(card=CARD, patches=box().patches, hinges=unglued)
    poses = sweep.poses.copy()
    assert Crossings(box()).deepest(type(sweep)(half, sweep.theta, poses, sweep.states, complete=True)) == (
        0,
        (),
    )
    poses[:, sweep.index["M1.L"], :3, 3] -= 5.0 * sweep.poses[:, sweep.index["G"], :3, 2]
    off = type(sweep)(half, sweep.theta, poses, sweep.states, complete=True)
    depth, pair = Crossings(box()).deepest(off)
    assert depth > 4.0
    assert set(pair) == {"G", "M1.L"}


def test_parts_that_turn_through_each_other_about_their_line_are_found() -> None:
    """Negative control: a side that is turned on through the page on which it stands, in one leap."""
    sweep, design = fold_design(box(), 45).sweep, box()
    foot = next(hinge for hinge in design.hinges if set(hinge.patches) == {"G", "M1.L"})
    names = ("G", "M1.L")
    patches = tuple(patch for patch in design.patches if patch.id in names)
    glued, loose = (Design(card=CARD, patches=patches, hinges=hinges) for hinges in ((foot,), ()))
    for degrees, passes in ((80.0, False), (-80.0, False), (150.0, True), (-150.0, True)):
        swung = turned_over(foot.points, np.array([0.0, degrees / 2, degrees, degrees]))
        poses = np.stack([np.broadcast_to(np.eye(4), swung.shape), swung], axis=1)
        for kept in (glued, loose):
            moved = type(sweep)(kept, np.radians([150.0, 90.0, 30.0, 0.0]), poses, np.zeros((4, 0)), complete=True)
            depth, pair = Crossings(glued).deepest(moved)
            assert (depth > 1.0) == passes
            assert set(pair) == (set(names) if passes else set())


@given(st.integers(1, 6), st.integers(0, 8), st.integers(0, 3), st.booleans())
def test_what_is_not_led_is_decided_by_the_loops(count: int, gaps: int, less: int, on_card: bool) -> None:
    """Held, the led joints leave nothing free; of the others none could be left out."""
    rng = np.random.default_rng(count + 10 * gaps + 100 * less)
    matrix = rng.normal(size=(gaps, max(count - less, 0))) @ rng.normal(size=(max(count - less, 0), count))
    fold = 0 if on_card else None
    led = led_joints(matrix, fold)
    rest = [k for k in range(count) if k not in led]
    assert len(led) >= 1
    assert fold is None or fold in led
    if rest:
        assert np.linalg.matrix_rank(matrix[:, rest]) == len(rest)
    if fold is None and np.linalg.matrix_rank(matrix) < count:
        assert len(led) == count - np.linalg.matrix_rank(matrix)


def test_what_is_wrong_by_less_than_paper_gives_is_pressed_flat_in_the_end() -> None:
    """The gap that is told then is that by which b + r misses c + t_b."""
    for wrong, folds in ((0.1, True), (2.0, False)):
        last = mismatched(wrong).steps[-2].evidence
        assert last is not None
        assert last.folded is not None
        assert last.folded.gap == pytest.approx(wrong, rel=0.05)
        assert last.feasible == folds


def test_a_tube_that_misses_by_what_paper_gives_is_not_led_from_where_it_lies_open() -> None:
    """Recorded in steps of 4 degrees, the angle nearest to 178 is 180: there its tops could go up or down."""
    tube = next(
        step.evidence.folded
        for step in mismatched(0.1).steps
        if step.evidence is not None and step.evidence.folded is not None and step.evidence.folded.led == 2
    )
    assert tube.refusal is None


def test_loops_that_decide_over_nothing_leave_all_to_the_hands() -> None:
    """Halves of a patch, hinged on one line, close a loop whose matrix is rounding; that must not count."""
    rounding = 1e-15 * np.random.default_rng(0).normal(size=(6, 5))
    assert led_joints(rounding, None).tolist() == [0, 1, 2, 3, 4]
    assert led_joints(rounding, 2).tolist() == [0, 1, 2, 3, 4]


def test_what_is_half_made_follows_the_hands_where_halves_of_patches_hang_on_one_line() -> None:
    """The seams of this design are glued after the halves are hinged: nothing wanders, nothing crosses."""
    design = random_design(1, mechanisms=(1, 2)).design
    ready = Kit(lay_out(design, paper="200x180mm"), fold_design(design, 45).sweep)
    assert any(joint.hinge is None for joint in ready.layout.joints)
    folding = Folding(ready)
    for proof in [proof for proof in find_order(ready).proofs if proof.joints][:8]:
        assert folding.folded(proof).refusal is None


@pytest.mark.parametrize(
    ("measured", "word"),
    [((1.0, 0.0, 0.0), "opens"), ((0.0, 1.0, 0.0), "stand"), ((0.0, 0.0, 0.2), "through"), ((0.0, 0.0, 0.0), "")],
)
def test_each_measure_has_its_reason(measured: tuple[float, float, float], word: str) -> None:
    refusal = Folded(3, 1, *measured, ("a", "b")).refusal
    assert (refusal is None) == (not word)
    assert word in (refusal or "")
