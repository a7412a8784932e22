"""The layout of one box-fold, counted and measured by hand."""

from collections import Counter

import numpy as np
import pytest

from popsim.design import Design, Hinge
from popsim.layout import Crease, Face, Layout, lay_out


@pytest.fixture(scope="module")
def layout(box: Design) -> Layout:
    return lay_out(box)


def test_pieces(layout: Layout) -> None:
    # the card unfolds flat; so do sides, tops and both end pairs; the backbone is glued to both
    assert [set(piece.motions) for piece in layout.pieces] == [
        {"G", "B"},
        {f"M1.{role}" for role in ("L", "R", "T_G", "T_B", "F_L", "F_R", "B_L", "B_R")},
        {"M1.C"},
    ]
    assert layout.sheet_count == 1


def test_every_hinge_is_a_fold_or_a_glue_joint_once(box: Design, layout: Layout) -> None:
    folds = [fold.joint.id for piece in layout.pieces for fold in piece.folds]
    flaps = [flap.joint.id for flap in layout.flaps]
    inner = Counter(folds) - Counter(flaps)  # each flap has a crease of its own
    assert sorted([*inner.elements(), *flaps]) == sorted(hinge.id for hinge in box.hinges)
    # 9 folds join 8 patches of the box, so a tree of 7 is the most; with the central fold 8 of 14 hinges
    assert sum(inner.values()) == 8
    assert len(flaps) == 6


def test_unfolded_patches_keep_their_area(box: Design, layout: Layout) -> None:
    flaps = sum(flap.polygon.area for flap in layout.flaps)
    patches = sum(patch.plane.polygon(patch.points).area for patch in box.patches)
    assert sum(piece.outline.area for piece in layout.pieces) == pytest.approx(flaps + patches, abs=0.5)


def test_mountain_and_valley(box: Design, layout: Layout) -> None:
    def pair(hinge: Hinge) -> frozenset[str]:
        return frozenset(name.removeprefix("M1.") for name in hinge.patches)

    creases = {
        pair(fold.joint.hinge): fold.crease
        for piece in layout.pieces
        for fold in piece.folds
        if fold.joint.hinge and fold.joint.id not in {flap.joint.id for flap in layout.flaps}
    }
    assert creases[frozenset({"G", "B"})] is Crease.VALLEY
    assert creases[frozenset({"T_G", "T_B"})] is Crease.VALLEY  # sinks between the sides
    for patches, crease in creases.items():
        if patches not in ({"G", "B"}, {"T_G", "T_B"}):
            assert crease is Crease.MOUNTAIN, patches  # edges of the box, and end pairs bulge outward


def test_a_flat_crease_follows_its_vector(box: Design) -> None:
    flipped = tuple(
        h.model_copy(update={"crease": tuple(-v for v in h.crease)}) if h.kind == "fold" and h.crease else h
        for h in box.hinges
    )
    layouts = [lay_out(design) for design in (box, box.model_copy(update={"hinges": flipped}))]
    flat = {h.id for h in box.hinges if h.kind == "fold" and h.crease}
    for one, other in zip(*(sum((p.folds for p in layout.pieces), ()) for layout in layouts), strict=True):
        assert (one.crease is other.crease) == (one.joint.id not in flat)


def test_flaps_are_trapezoids_of_5_mm(layout: Layout) -> None:
    base = next(flap for flap in layout.flaps if flap.joint.hinge and set(flap.joint.parts) == {"G", "M1.L"})
    assert base.carrier == "M1.L"
    assert base.polygon.area == pytest.approx((59 + 49) / 2 * 5)  # 60 mm, 0.5 mm clear at each end, 45 degrees
    line = np.linalg.norm(base.line[1] - base.line[0])
    assert line == pytest.approx(59)


def test_flaps_of_sides_land_inside_the_box_and_fold_backward(layout: Layout) -> None:
    for page, side in (("G", "L"), ("B", "R")):
        flap = next(f for f in layout.flaps if set(f.joint.parts) == {page, f"M1.{side}"})
        spots = layout.parts[page].plane.lift(np.array(flap.landing.exterior.coords))
        assert np.abs(spots[:, 1]).max() == pytest.approx(20)
        assert np.abs(spots[:, 1]).min() == pytest.approx(15)
        assert flap.face is Face.PRINTED
        assert flap.crease is Crease.MOUNTAIN
        assert flap.glue_on_print


def test_the_backbone_carries_its_flaps_to_the_ground_and_under_the_top(layout: Layout) -> None:
    flaps = {f.target: f for f in layout.flaps if f.carrier == "M1.C"}
    assert set(flaps) == {"G", "M1.T_G"}
    assert flaps["G"].face is Face.PRINTED
    assert flaps["M1.T_G"].face is Face.REVERSE


def test_end_pairs_close_behind_the_printed_sides(layout: Layout) -> None:
    closing = [f for f in layout.flaps if "M1.C" not in f.joint.parts and not {"G", "B"} & set(f.joint.parts)]
    assert len(closing) == 2
    assert all(f.face is Face.REVERSE and f.glue_on_print and f.crease is Crease.MOUNTAIN for f in closing)
