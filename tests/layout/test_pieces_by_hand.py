"""Pieces of designs written by hand: printed sides, loops, self-overlap, holes."""

import numpy as np
import pytest

from popsim.design import Card, Design, Hinge, Patch
from popsim.design.rules import check_rules
from popsim.layout import lay_out

CARD = Card(x=(-60, 60), depth=90)
GROUND = Patch(id="G", outline=((-60, 0, 0), (60, 0, 0), (60, 90, 0), (-60, 90, 0)))
BACKDROP = Patch(id="B", outline=((-60, -90, 0), (60, -90, 0), (60, 0, 0), (-60, 0, 0)))
CENTRAL = Hinge(
    id="h0", patches=("G", "B"), axis=((-60, 0, 0), (60, 0, 0)), kind="central", crease=(0.0, 0.0, -1.0)
)


def design(patches: list[Patch], hinges: list[Hinge]) -> Design:
    made = Design(card=CARD, patches=(GROUND, BACKDROP, *patches), hinges=(CENTRAL, *hinges))
    check_rules(made)
    return made


def wall(name: str, a: tuple[float, float], b: tuple[float, float], low: float = 0, high: float = 20) -> Patch:
    """Upright rectangle over the ground from a to b, printed on the right-hand side."""
    return Patch(id=name, outline=((*a, low), (*b, low), (*b, high), (*a, high)))


def fold(name: str, one: str, other: str, at: tuple[float, float], high: float = 20) -> Hinge:
    return Hinge(id=name, patches=(one, other), axis=((*at, 0), (*at, high)), kind="fold")


def foot(name: str, patch: str, a: tuple[float, float], b: tuple[float, float]) -> Hinge:
    return Hinge(id=name, patches=("G", patch), axis=((*a, 0), (*b, 0)), kind="glue")


def changed(made: Design, name: str, **fields: object) -> Design:
    """The design with some fields of one patch replaced."""
    data = made.model_dump()
    data["patches"] = [patch | (fields if patch["id"] == name else {}) for patch in data["patches"]]
    return Design.model_validate(data)


CORNERS = [(0.0, 20.0), (30.0, 20.0), (30.0, 50.0), (0.0, 50.0)]


def ring(printed: tuple[bool, ...] = (True,) * 4) -> Design:
    """Four walls round a square; `printed` outside or, reversed, inside."""
    walls, hinges = [], []
    for k, outside in enumerate(printed):
        a, b = CORNERS[k], CORNERS[(k + 1) % 4]
        patch = wall(f"W{k}", a, b)
        walls.append(patch if outside else patch.model_copy(update={"outline": patch.outline[::-1]}))
        hinges.append(foot(f"g{k}", f"W{k}", a, b))
        hinges.append(fold(f"f{k}", f"W{k}", f"W{(k + 1) % 4}", b))
    return design(walls, hinges)


def test_a_ring_opens_at_one_fold() -> None:
    layout = lay_out(ring())
    strip = next(piece for piece in layout.pieces if "W0" in piece.motions)
    assert set(strip.motions) == {"W0", "W1", "W2", "W3"}
    opened = [flap for flap in strip.flaps if flap.joint.hinge and flap.joint.hinge.kind == "fold"]
    assert len(opened) == 1


def test_patches_printed_on_different_sides_are_not_one_piece() -> None:
    layout = lay_out(ring((True, True, True, False)))
    assert [set(piece.motions) for piece in layout.pieces] == [{"G", "B"}, {"W0", "W1", "W2"}, {"W3"}]
    assert {flap.joint.id for flap in layout.flaps} >= {"f2", "f3"}


def test_the_texture_says_which_side_is_printed() -> None:
    # right x up points to -x, outside of W3, whose outline runs clockwise seen from there
    frame = {"origin": (0.0, 20.0, 0.0), "right": (0.0, 0.0, 20.0), "up": (0.0, 30.0, 0.0)}
    layout = lay_out(changed(ring((True, True, True, False)), "W3", texture_frame=frame))
    assert len(layout.pieces) == 2


def test_a_fold_with_a_gap_of_rounding_is_still_one_piece() -> None:
    made = ring()
    outline = [(x + 0.004, y, z) for x, y, z in made.patch_by_id["W1"].outline]
    layout = lay_out(changed(made, "W1", outline=outline))
    assert len(layout.pieces) == 2


def fan(heights: list[float], apex: float) -> Design:
    """Triangles round a point at height `apex`, folded along all edges to it; the rim at the given heights."""
    count = len(heights)
    angles = 2 * np.pi * np.arange(count) / count
    rim = [(float(25 * np.cos(a)), float(40 + 25 * np.sin(a)), z) for a, z in zip(angles, heights, strict=True)]
    top = (0.0, 40.0, apex)
    sides, folds = [], []
    for k in range(count):
        after = (k + 1) % count
        sides.append(Patch(id=f"P{k}", outline=(rim[k], rim[after], top)))
        folds.append(Hinge(id=f"f{k}", patches=(f"P{k}", f"P{after}"), axis=(rim[after], top), kind="fold"))
    return Design(card=CARD, patches=(GROUND, BACKDROP, *sides), hinges=(CENTRAL, *folds))


def test_a_loop_round_a_point_opens_once() -> None:
    layout = lay_out(fan([10.0] * 5, 60.0))
    cone = next(piece for piece in layout.pieces if "P0" in piece.motions)
    assert len(cone.motions) == 5
    assert len(cone.flaps) == 1
    areas = sum(layout.parts[name].polygon.area for name in cone.motions) + cone.flaps[0].polygon.area
    assert cone.outline.area == pytest.approx(areas, rel=1e-3)


def test_a_net_never_overlaps_itself() -> None:
    made = fan([10.0, 70.0] * 4, 40.0)
    apex = np.array([0.0, 40.0, 40.0])
    arms = [np.array(p.outline[:2]) - apex for p in made.popup_patches]
    total = sum(np.arccos(a @ b / np.linalg.norm(a) / np.linalg.norm(b)) for a, b in arms)
    assert total > 2 * np.pi  # so one piece of all eight would lie on itself
    layout = lay_out(made)
    nets = [piece for piece in layout.pieces if "G" not in piece.motions]
    assert len(nets) > 1
    for piece in nets:
        areas = sum(layout.parts[name].polygon.area for name in piece.motions)
        areas += sum(flap.polygon.area for flap in piece.flaps)
        assert piece.outline.area == pytest.approx(areas, rel=1e-3)


def test_holes_are_cut_out() -> None:
    hole = ((10.0, 20.0, 5.0), (20.0, 20.0, 5.0), (20.0, 20.0, 15.0), (10.0, 20.0, 15.0))
    layout = lay_out(changed(ring(), "W0", holes=(hole,)))
    strip = next(piece for piece in layout.pieces if "W0" in piece.motions)
    assert len(strip.outline.interiors) == 1


def test_flaps_of_two_joints_on_one_edge_take_turns() -> None:
    # a wall on the central fold, glued to both pages, whose foot alone can carry flaps
    spine = Patch(id="C", outline=((-40, 0, 0), (40, 0, 0), (40, 0, 30), (-40, 0, 30)))
    feet = [
        Hinge(id=f"c{page}", patches=(page, "C"), axis=((-40, 0, 0), (40, 0, 0)), kind="glue")
        for page in ("G", "B")
    ]
    layout = lay_out(design([spine], feet))
    flaps = [flap for flap in layout.flaps if flap.carrier == "C"]
    assert [(flap.joint.id, flap.target) for flap in flaps] == [("cG", "G")] * 2 + [("cB", "B")] * 2
    along = sorted((sorted(flap.line[:, 0]), flap.target) for flap in flaps)
    assert [target for _, target in along] == ["G", "B", "G", "B"]
    lengths = [line[1] - line[0] for line, _ in along]
    assert lengths == pytest.approx([19.0] * 4)


def test_a_net_opens_where_it_leaves_no_room_for_a_flap() -> None:
    # a wall with a step in its outline: the lid over the low part unfolds along the edge of the high part,
    # to which a patch standing across the wall must be glued; that patch has paper on both sides of the line
    wall_shape = Patch(
        id="W", outline=((0, 20, 0), (40, 20, 0), (40, 20, 20), (20, 20, 20), (20, 20, 50), (0, 20, 50))
    )
    lid = Patch(id="T", outline=((20, 20, 20), (40, 20, 20), (40, 50, 20), (20, 50, 20)))
    across = Patch(id="X", outline=((20, 10, 22), (20, 40, 22), (20, 40, 48), (20, 10, 48)))
    hinges = [
        foot("g", "W", (0.0, 20.0), (40.0, 20.0)),
        Hinge(id="t", patches=("W", "T"), axis=((20, 20, 20), (40, 20, 20)), kind="fold"),
        Hinge(id="x", patches=("W", "X"), axis=((20, 20, 22), (20, 20, 48)), kind="glue"),
    ]
    layout = lay_out(design([wall_shape, lid, across], hinges))
    assert layout.piece_of["W"] is not layout.piece_of["T"]
    (flap,) = (flap for flap in layout.flaps if flap.joint.id == "x")
    assert (flap.carrier, flap.target) == ("W", "X")
    without = lay_out(design([wall_shape, lid], hinges[:2]))
    assert without.piece_of["W"] is without.piece_of["T"]


def notched(*feet: tuple[float, float]) -> Design:
    """A wall that stands on some stretches of its foot alone; a hinge for each."""
    rim = [(x, 20.0, z) for low, high in feet for x, z in ((low, 6.0), (low, 0.0), (high, 0.0), (high, 6.0))]
    outline = (*rim[1:-1], (feet[-1][1], 20.0, 20.0), (feet[0][0], 20.0, 20.0))
    standing = Patch(id="W", outline=outline)
    return design([standing], [foot(f"g{k}", "W", (a, 20.0), (b, 20.0)) for k, (a, b) in enumerate(feet)])


def test_hinges_on_one_line_are_one_joint_with_one_number() -> None:
    layout = lay_out(notched((-30.0, -10.0), (0.0, 20.0)))
    (joint,) = (joint for joint in layout.joints if "W" in joint.parts)
    assert [hinge.id for hinge in joint.hinges] == ["g0", "g1"]
    assert [np.ptp(ends[:, 0]) for ends in joint.stretches] == pytest.approx([20.0, 20.0])
    assert layout.numbers == {"g0": 1}
    assert [flap.stretch for flap in layout.flaps] == [0, 1]


def test_a_stretch_too_short_to_hold_gets_no_flap_beside_a_longer_one() -> None:
    layout = lay_out(notched((-30.0, -27.0), (0.0, 20.0)))
    assert [flap.stretch for flap in layout.flaps] == [1]
    alone = lay_out(notched((-30.0, -27.0)))
    assert len(alone.flaps) == 1
