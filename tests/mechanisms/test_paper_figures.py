"""The paper's own numbers: Sec. 3.2, Sec. 3.3, Table 1, and closed heights in numbers."""

from collections.abc import Callable

import numpy as np
import pytest

from popsim.design import Card
from popsim.geometry.frame import Side, page_direction
from popsim.geometry.rigid import transform
from popsim.mechanisms import (
    MECHANISMS,
    BasePatchPair,
    Mechanism,
    PairKind,
    RectangularPrism,
    TriangularPrism,
    card_pair,
)
from popsim.mechanisms.box_fold import BoxFold, EndPair, Top
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.mechanisms.v_fold_1 import VFold1
from popsim.mechanisms.v_fold_2 import VFold2

CARD = Card(x=(-150.0, 150.0), depth=200.0)
PAIR = card_pair(CARD)
ROOT = float(np.sqrt(2))
THETA = np.radians([180.0, 150.0, 90.0, 30.0, 0.0])
ALPHA = THETA / 2


def corner(box: BoxFold) -> BasePatchPair:
    return next(pair for pair in box.pairs() if pair.kind is PairKind.CORNER and pair.side is Side.GROUND)


BOX = BoxFold.plain("M1", PAIR, 20.0, 45.0, (-30.0, 10.0))
TENT = TentFold("M1", PAIR, (-30.0, 10.0), 20.0, 15.0)
STEP = StepFold("M2", corner(BOX), (-5.0, 8.0), 12.0, 30.0)
V1 = VFold1("M1", PAIR, 10.0, 30.0, 24.0)
V2 = VFold2("M1", PAIR, 10.0, 30.0, 24.0)
LAYERED = BoxFold.stepped("M1", PAIR, 20.0, (Top(-30.0, -10.0, 25.0), Top(-10.0, 5.0, 45.0), Top(5.0, 40.0, 30.0)))


def test_registry_holds_the_mechanisms_of_section_3_2() -> None:
    assert set(MECHANISMS) == {"box-fold", "tent-fold", "v-fold-1", "v-fold-2", "step-fold"}


@pytest.mark.parametrize(
    ("mechanism", "roles"),
    [
        (BOX, "L R C T_G T_B F_L F_R B_L B_R"),
        (V1, "F_L F_R T_G T_B B_L B_R"),
        (V2, "F_L F_R T_G T_B"),
        (TENT, "T_3 T_4"),
        (STEP, "riser tread"),
    ],
    ids=["box-fold", "v-fold-1", "v-fold-2", "tent-fold", "step-fold"],
)
def test_patches_of_section_3_2(mechanism: Mechanism, roles: str) -> None:
    assert {plate.role for plate in mechanism.plates()} == set(roles.split())


def glued(mechanism: Mechanism) -> set[frozenset[str]]:
    return {
        frozenset(mechanism.patch_id(role).removeprefix("M1.") for role in j.roles) for j in mechanism.joints()
    }


def test_hinges_of_a_v_fold() -> None:
    """Sec. 3.2.3: {B, F_R}, {G, F_L}, {F_L, T_G}, {F_R, T_B} and the ring; not {T_B, B_R}, {T_G, B_L}."""
    ring = ["F_L F_R", "F_R B_R", "B_R B_L", "B_L F_L"]
    others = ["B F_R", "G F_L", "F_L T_G", "F_R T_B", "T_G T_B"]
    assert glued(V1) == {frozenset(names.split()) for names in (*ring, *others)}


def test_end_pairs_are_not_glued_to_the_backbone() -> None:
    with_backbone = {other for pair in glued(BOX) if "C" in pair for other in pair - {"C"}}
    assert with_backbone in ({"G", "T_G"}, {"G", "B", "T_G", "T_B"})


RANGES: list[tuple[Mechanism, tuple[float, float]]] = [
    (BOX, (-30.0 - 20.0, 10.0 + 20.0)),
    (LAYERED, (-30.0 - 20.0, 40.0 + 20.0)),
    (V1, (10.0 - 30.0 * ROOT, 10.0 + 24.0 / ROOT)),
    (V2, (10.0 - 30.0 / ROOT, 10.0 + 24.0 / ROOT)),
    (VFold1("M1", PAIR, 10.0, 30.0, 24.0, -1), (10.0 - 24.0 / ROOT, 10.0 + 30.0 * ROOT)),
    (VFold2("M1", PAIR, 10.0, 30.0, 24.0, -1), (10.0 - 24.0 / ROOT, 10.0 + 30.0 / ROOT)),
    (TENT, (-30.0, 10.0)),
    (STEP, (-5.0, 8.0)),
]


@pytest.mark.parametrize(("mechanism", "expected"), RANGES, ids=lambda value: getattr(value, "type", ""))
def test_closing_range_of_section_3_3_2(mechanism: Mechanism, expected: tuple[float, float]) -> None:
    assert mechanism.closing_range() == pytest.approx(expected, abs=1e-9)
    swept = mechanism.swept(np.linspace(np.pi, 0, 91))[..., 0]
    assert (swept.min(), swept.max()) == pytest.approx(expected, abs=1e-9)


def test_end_pair_of_one_side_only_widens_the_range_on_that_side() -> None:
    front = BoxFold("M1", PAIR, 20.0, BOX.tops, (EndPair(10.0, 0.0, 45.0, 1),))
    assert front.closing_range() == (-30.0, 30.0)


HEIGHTS: list[tuple[Mechanism, float]] = [
    (BOX, 20.0 + 45.0),
    (LAYERED, 20.0 + 45.0),
    (TENT, 20.0 + 25.0),
    (V1, 30.0 * ROOT + 24.0 / ROOT),
    (VFold1("M1", PAIR, 10.0, 4.0, 60.0), 4.0 * ROOT + 60.0 / ROOT),
    (V2, (30.0 + 24.0) / ROOT),
    (STEP, 20.0 + 12.0 + 30.0),
]


@pytest.mark.parametrize(("mechanism", "expected"), HEIGHTS, ids=lambda value: getattr(value, "type", ""))
def test_closed_height(mechanism: Mechanism, expected: float) -> None:
    assert mechanism.closed_extent() == pytest.approx(expected, abs=1e-9)
    assert mechanism.swept(np.array([0.0]))[..., 2].max() == pytest.approx(expected, abs=1e-9)


def test_front_fold_of_a_box_moves_out_and_up_by_w_cos_alpha() -> None:
    fold = next(joint for joint in BOX.joints() if set(joint.roles) == {"F_L", "F_R"})
    moved = transform(BOX.poses(THETA)["F_L"], fold.axis)
    low = np.stack([10 + 20 * np.cos(ALPHA), 0 * ALPHA, 20 * np.cos(ALPHA)], axis=-1)
    assert moved[:, 0] == pytest.approx(low, abs=1e-9)
    assert moved[:, 1] == pytest.approx(low + np.array([0, 0, 45]), abs=1e-9)


def test_apex_of_a_tent() -> None:
    """Z = t1 cos a + sqrt(t3^2 - t1^2 sin^2 a), and it stays over the fold."""
    ridge = next(joint for joint in TENT.joints() if set(joint.roles) == {"T_3", "T_4"})
    moved = transform(TENT.poses(THETA)["T_3"], ridge.axis)
    assert moved[..., 1] == pytest.approx(0, abs=1e-9)
    height = 20 * np.cos(ALPHA) + np.sqrt(25.0**2 - (20 * np.sin(ALPHA)) ** 2)
    assert moved[..., 2] == pytest.approx(np.stack([height, height], axis=-1), abs=1e-9)


@pytest.mark.parametrize("facing", [1, -1])
def test_walls_of_a_v_fold_leave_the_fold_line_at_45_degrees(facing) -> None:
    fold = VFold2("M1", PAIR, 10.0, 30.0, 24.0, facing)
    poses = fold.poses(THETA)
    for side, role in ((Side.GROUND, "F_L"), (Side.BACKDROP, "F_R")):
        foot = next(
            joint for joint in fold.joints() if joint.roles[1] == role and joint.roles[0].startswith("base")
        )
        moved = transform(poses[role], foot.axis)
        expected = (page_direction(side, THETA) - [facing, 0, 0]) / ROOT
        assert (moved[:, 1] - moved[:, 0]) / 30 == pytest.approx(expected, abs=1e-9)
    edge = next(joint for joint in fold.joints() if set(joint.roles) == {"F_L", "F_R"})
    moved = transform(poses["F_L"], edge.axis)
    lean = np.stack([facing * np.cos(ALPHA), 0 * ALPHA, 1 + 0 * ALPHA], axis=-1)
    assert (moved[:, 1] - moved[:, 0]) / 24 == pytest.approx(lean / np.sqrt(1 + np.cos(ALPHA) ** 2)[:, None])


def test_back_corner_of_a_v_fold_rises() -> None:
    end = np.array([[V1.back, 0.0, 0.0]])
    moved = transform(V1.poses(THETA)["B_L"], end)[:, 0]
    assert moved[:, 0] == pytest.approx(10 - 30 * ROOT)
    assert moved[:, 2] == pytest.approx(30 * ROOT * np.cos(ALPHA), abs=1e-9)


BOX_PRISM = RectangularPrism((-30.0, -20.0, 0.0), (10.0, 20.0, 45.0))
TURNED = RectangularPrism((-20.0, -20.0, 0.0), (20.0, 20.0, 45.0), turned=True)
ROOF = TriangularPrism((-30.0, -20.0, 0.0), (10.0, 20.0, 15.0), "x")
WEDGE = TriangularPrism((-10.0, -20.0, 0.0), (10.0, 20.0, 45.0), "z")
BESIDE = RectangularPrism((-5.0, 20.0, 0.0), (8.0, 32.0, 30.0))


def mapped(primitive: RectangularPrism | TriangularPrism) -> set[str]:
    pairs = (PAIR, corner(BOX))
    return {
        name
        for name, kind in MECHANISMS.items()
        for pair in pairs
        for _ in kind.from_primitive(primitive, pair, "M1")
    }


def test_table_1() -> None:
    """Rectangular prism: step, v-fold, box. Triangular prism: v-fold, tent."""
    rectangular = mapped(BOX_PRISM) | mapped(TURNED) | mapped(BESIDE)
    triangular = mapped(ROOF) | mapped(WEDGE)
    assert rectangular == {"step-fold", "v-fold-1", "box-fold"}
    assert triangular == {"v-fold-2", "tent-fold"}


@pytest.mark.parametrize(
    ("primitive", "pair", "kind"),
    [
        (BOX_PRISM, PAIR, "box-fold"),
        (TURNED, PAIR, "v-fold-1"),
        (ROOF, PAIR, "tent-fold"),
        (WEDGE, PAIR, "v-fold-2"),
        (BESIDE, corner(BOX), "step-fold"),
    ],
    ids=["box-fold", "v-fold-1", "tent-fold", "v-fold-2", "step-fold"],
)
def test_mechanism_fills_its_primitive(
    primitive: RectangularPrism | TriangularPrism, pair: BasePatchPair, kind: str
) -> None:
    (*_, mechanism) = MECHANISMS[kind].from_primitive(primitive, pair, "M1")
    corners = np.concatenate([plate.outline for plate in mechanism.plates()])
    assert corners.min(axis=0) == pytest.approx(primitive.low, abs=1e-9)
    assert corners.max(axis=0) == pytest.approx(primitive.high, abs=1e-9)


Prism = RectangularPrism | TriangularPrism


@pytest.mark.parametrize(
    ("prism", "areas"),
    [
        (BOX_PRISM, [40 * 40] * 2 + [40 * 45] * 4),
        (TURNED, [800.0] * 2 + [20 * ROOT * 45] * 4),
        (ROOF, [40 * 15 / 2] * 2 + [40 * 40, 25 * 40, 25 * 40]),
        (WEDGE, [40 * 20 / 2] * 2 + [40 * 45, 20 * ROOT * 45, 20 * ROOT * 45]),
    ],
    ids=["box", "turned", "roof", "wedge"],
)
def test_areas_of_faces(prism: Prism, areas: list[float]) -> None:
    assert sorted(prism.face_areas()) == pytest.approx(sorted(areas))


@pytest.mark.parametrize(
    ("mechanism", "prism", "cover"),
    [
        (BOX, BOX_PRISM, 1 - 40 * 40 / (2 * 40 * 40 + 4 * 40 * 45)),
        (TENT, ROOF, 2 * 25 * 40 / (600 + 1600 + 2000)),
    ],
    ids=["box-fold", "tent-fold"],
)
def test_principal_faces_of_equation_2(mechanism: Mechanism, prism: Prism, cover: float) -> None:
    """A box-fold covers all faces but the one it stands on; a tent-fold its two slopes."""
    from popsim.geometry.plane import area_vector

    shown = sum(np.linalg.norm(area_vector(plate.outline)) / 2 for plate in mechanism.plates() if plate.principal)
    assert shown / sum(prism.face_areas()) == pytest.approx(cover)


@pytest.mark.parametrize("outside", [(-200.0, 10.0), (-30.0, 200.0)])
def test_primitive_beside_its_pair_is_none(outside: tuple[float, float]) -> None:
    prism = RectangularPrism((outside[0], -20.0, 0.0), (outside[1], 20.0, 45.0))
    assert mapped(prism) == set()


WRONG: list[Callable[[], Mechanism]] = [
    lambda: BoxFold.plain("M1", PAIR, 0.0, 45.0, (-30.0, 10.0)),
    lambda: BoxFold.plain("M1", PAIR, 20.0, -1.0, (-30.0, 10.0)),
    lambda: BoxFold.plain("M1", PAIR, 20.0, 45.0, (10.0, -30.0)),
    lambda: BoxFold("M1", PAIR, 20.0, (), ()),
    lambda: BoxFold.stepped("M1", PAIR, 20.0, (Top(0.0, 10.0, 5.0), Top(11.0, 20.0, 8.0))),
    lambda: BoxFold.stepped("M1", PAIR, 20.0, (Top(0.0, 10.0, 5.0), Top(10.0, 20.0, 5.0))),
    lambda: TentFold("M1", PAIR, (0.0, 0.0), 20.0, 15.0),
    lambda: TentFold("M1", PAIR, (0.0, 9.0), float("nan"), 15.0),
    lambda: VFold1("M1", PAIR, 0.0, float("inf"), 24.0),
    lambda: VFold2("M1", PAIR, 0.0, 30.0, 24.0, 0),
    lambda: StepFold("M2", corner(BOX), (-5.0, 8.0), 12.0, 0.0),
]


@pytest.mark.parametrize("make", WRONG)
def test_parameters_that_are_no_mechanism(make: Callable[[], Mechanism]) -> None:
    from popsim.errors import GeometryError

    with pytest.raises(GeometryError, match=r"^M\d: "):
        make()
