"""Random designs: valid by construction, or broken in exactly one aspect, and the same from the same seed."""

from collections import Counter

import numpy as np
import pytest
from oracles.crossing import crossings

from popsim.design import dump_design, parse_design
from popsim.design.rules import check_rules
from popsim.errors import InputError
from popsim.mechanisms import MECHANISMS
from popsim.validity import examine
from popsim.verification.random_designs import FLAWS, random_design

FOLDING = np.radians([170.0, 140.0, 115.0, 90.0, 65.0, 40.0, 15.0])
every_flaw = pytest.mark.parametrize("flaw", FLAWS)


@pytest.mark.parametrize("breaking", [None, *FLAWS])
def test_same_seed_gives_the_same_design(breaking) -> None:
    first, second = (random_design(11, mechanisms=(1, 6), breaking=breaking) for _ in range(2))
    assert dump_design(first.design) == dump_design(second.design)
    assert first.note == second.note
    assert parse_design(dump_design(first.design)) == first.design


@pytest.mark.parametrize("seed", range(12))
def test_valid_designs_hold_with_room_to_spare(seed: int) -> None:
    theory = examine(random_design(seed, mechanisms=(1, 12)).design)
    assert set(theory.mechanisms) == {record.id for record in theory.design.mechanisms}
    assert all(condition.margin > 0 for condition in theory.conditions)


@pytest.mark.parametrize("seed", range(6))
def test_valid_designs_do_not_cross_at_any_angle(seed: int) -> None:
    design = random_design(seed, mechanisms=(3, 6)).design
    assert list(crossings(design, examine(design).poses(FOLDING), FOLDING)) == []


@every_flaw
@pytest.mark.parametrize("seed", range(6))
def test_flaw_breaks_its_aspect_and_no_other(flaw: str, seed: int) -> None:
    drawn = random_design(seed, mechanisms=(1, 6), breaking=flaw)
    broken = [condition for condition in examine(drawn.design).conditions if not condition.holds]
    assert {condition.aspect for condition in broken} == {drawn.expected} == {FLAWS[flaw].aspect}
    assert drawn.note


@pytest.mark.parametrize("flaw", [name for name, flaw in FLAWS.items() if flaw.aspect == "clear"])
@pytest.mark.parametrize("seed", range(3))
def test_designs_that_are_not_clear_do_cross(flaw: str, seed: int) -> None:
    design = random_design(seed, mechanisms=(1, 4), breaking=flaw).design
    found = list(crossings(design, examine(design).poses(FOLDING), FOLDING))
    assert max((crossing.depth for crossing in found), default=0) > 1


def test_all_mechanisms_are_drawn_and_nested_four_deep() -> None:
    drawn, levels = Counter(), Counter()
    for seed in range(12):
        theory = examine(random_design(seed, mechanisms=(10, 20)).design)
        drawn.update(mechanism.type for mechanism in theory.mechanisms.values())
        level: dict[str | None, int] = {None: 0}
        for name, mechanism in theory.mechanisms.items():
            level[name] = level[mechanism.pair.owner] + 1
        levels.update(level.values())
    assert set(drawn) == set(MECHANISMS)
    assert {1, 2, 3, 4} <= set(levels)
    assert max(levels) == 4


def test_some_patches_have_notches_and_windows() -> None:
    patches = [patch for seed in range(12) for patch in random_design(seed, mechanisms=(3, 8)).design.patches]
    polygons = [patch.plane.polygon(patch.points, patch.hole_points) for patch in patches]
    assert any(polygon.interiors for polygon in polygons)
    assert any(
        len(polygon.exterior.coords) > 5 and polygon.convex_hull.area > polygon.area for polygon in polygons
    )


def test_some_plates_inside_rise_as_fins_through_slits() -> None:
    drawn = [random_design(seed, mechanisms=(1, 6)) for seed in range(40)]
    risen, slits = 0, 0
    for design in (each.design for each in drawn if not each.note.endswith(" 0 fins")):
        check_rules(design)
        theory = examine(design)
        assert theory.holds
        inside = {
            f"{name}.{plate.role}"
            for name, mechanism in theory.mechanisms.items()
            for plate in mechanism.plates()
            if not plate.principal
        }
        for name in inside:
            ridges = [hinge.points[:, 2].max() for hinge in design.hinges_by_patch[name]]
            if design.patch_by_id[name].points[:, 2].max() > max(ridges) + 1:
                risen += 1
                tops = {hinge.other(name) for hinge in design.hinges_by_patch[name]} - {"G", "B"}
                slits += any(len(design.patch_by_id[top].points) > 4 for top in tops)
    assert risen >= 5
    assert slits == risen


def test_tops_are_recognised_whole_on_both_sides_of_a_slit() -> None:
    """A fin of M4 beside the tent M6 on the same top: two ridges of one top."""
    design = random_design(1237097411, mechanisms=(1, 40)).design
    assert len([hinge for hinge in design.hinges if set(hinge.patches) == {"M4.T_G", "M4.T_B"}]) == 2
    assert examine(design).holds


def test_number_of_mechanisms_keeps_to_its_limits() -> None:
    counts = [len(random_design(seed, mechanisms=(2, 5)).design.mechanisms) for seed in range(20)]
    assert set(counts) <= {2, 3, 4, 5}
    assert len(random_design(0, mechanisms=(40, 40)).design.mechanisms) == 40


@pytest.mark.parametrize("limits", [(0, 3), (4, 3), (-1, -1)])
def test_impossible_limits_are_refused(limits: tuple[int, int]) -> None:
    with pytest.raises(InputError, match="mechanisms"):
        random_design(0, mechanisms=limits)


def test_more_than_fits_is_refused() -> None:
    with pytest.raises(InputError, match="do not fit"):
        random_design(0, mechanisms=(400, 400), depth=1)


def test_unknown_flaw_is_refused_with_those_there_are() -> None:
    with pytest.raises(InputError, match="shear, lengths"):
        random_design(0, breaking="ugly")
