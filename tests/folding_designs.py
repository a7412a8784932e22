"""Designs that the tests of simulation and verification fold: sound ones, and ones with one fault."""

from collections.abc import Callable, Iterable

import numpy as np

from popsim.design import Card, Design, dump_design, parse_design
from popsim.mechanisms import BasePatchPair, Mechanism, PairKind, assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold, EndPair, Top
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.mechanisms.v_fold_1 import VFold1
from popsim.mechanisms.v_fold_2 import VFold2

CARD = Card(x=(-150, 150), depth=200)
CARD_PAIR = card_pair(CARD)


def plain_box(half_width: float = 30, height: float = 40, x: tuple[float, float] = (-20, 20)) -> Design:
    """One box-fold."""
    return assemble(CARD, [BoxFold.plain("M", CARD_PAIR, half_width, height, x)])


def tower() -> tuple[Design, list[Mechanism]]:
    """A box, a box on it, a tent on that, and steps in two kinds of corner (the example of the geometry page)."""
    low = BoxFold.plain("low", CARD_PAIR, 40, 30, (-50, 50))
    high = BoxFold.plain("high", opening(low), 20, 30, (-20, 20))
    tent = TentFold("tent", opening(high), (-15, 15), 15, 20)
    beside = StepFold("beside", corners(low)[0], (-30, 30), 20, 15)
    upper = StepFold("upper", corners(high)[0], (-15, 15), 10, 12)
    parts: list[Mechanism] = [low, high, tent, beside, upper]
    return assemble(CARD, parts), parts


def wedges() -> tuple[Design, list[Mechanism]]:
    """V-folds of both types, facing either way."""
    parts: list[Mechanism] = [
        VFold1("a", CARD_PAIR, -50, 30, 25, -1),
        VFold1("b", CARD_PAIR, 50, 30, 25, 1),
        VFold2("c", CARD_PAIR, -120, 20, 20, -1),
        VFold2("d", CARD_PAIR, 120, 20, 20, 1),
    ]
    return assemble(CARD, parts), parts


def layered() -> tuple[Design, list[Mechanism]]:
    """One box-fold with three tops and four end pairs, like a car."""
    tops = (Top(-60, -20, 30), Top(-20, 30, 60), Top(30, 60, 45))
    box = BoxFold.stepped("car", CARD_PAIR, 35, tops)
    return assemble(CARD, [box]), [box]


def pair_inside(low: float, high: float) -> Design:
    """A box with a front pair inside its profile, from `low` to `high`."""
    ends = (EndPair(40, 0, 60, 1), EndPair(-40, 0, 60, -1), EndPair(0, low, high, 1))
    return assemble(CARD, [BoxFold("M", CARD_PAIR, 40, (Top(-40, 40, 60),), ends)])


def shearing_box() -> Design:
    """A box-fold without front and back pairs."""
    return without(plain_box(), {"M.F_L", "M.F_R", "M.B_L", "M.B_R"})


def mismatched_box(excess: float) -> Design:
    """A box whose backbone is `excess` mm too long: b + r != c + t_b."""

    def raise_ridge(patch: str, point: np.ndarray) -> np.ndarray:
        on_ridge = abs(point[1]) < 1e-6 and point[2] > 39 and patch in ("M.C", "M.T_G", "M.T_B", "")
        return point + np.array([0, 0, excess]) if on_ridge else point

    return reshaped(plain_box(), raise_ridge, fixed={frozenset(("M.F_L", "M.F_R")), frozenset(("M.B_L", "M.B_R"))})


def overlapping_boxes() -> Design:
    """Two boxes whose closing ranges overlap by 20 mm."""
    boxes = (BoxFold.plain("M", CARD_PAIR, 30, 40, (-60, -20)), BoxFold.plain("N", CARD_PAIR, 30, 40, (20, 60)))
    return assemble(CARD, boxes)


def leaning() -> Design:
    """A tall v-fold on a low box that leans over a taller neighbour; on the card itself nothing overlaps."""
    low = BoxFold.plain("low", CARD_PAIR, 20, 20, (-60, -20))
    fold = VFold2("lean", opening(low), -25, 15, 100, 1)
    return assemble(CARD, [low, fold, BoxFold.plain("tall", CARD_PAIR, 20, 70, (21, 60))])


def too_tall() -> Design:
    """A box that sticks 20 mm out of the closed card."""
    card = Card(x=(-150, 150), depth=100)
    return assemble(card, [BoxFold.plain("M", card_pair(card), 40, 80, (-20, 20))])


def slanted_box(slant: float) -> Design:
    """A box whose sides lean inward by `slant` mm, with b + r = c + t_b kept (Sec. 4.2)."""
    half, height = 30.0, 40.0
    side = np.hypot(height, slant)
    ridge = _ridge(half + side, half - slant, height)

    def lean(patch: str, point: np.ndarray) -> np.ndarray:
        x, y, z = point
        if z > 39 and abs(y) > 1:
            return np.array([x, np.sign(y) * (half - slant), z])
        if z > 39 and patch in ("M.C", "M.T_G", "M.T_B", ""):
            return np.array([x, y, ridge])
        return point

    ends = {frozenset(("M.F_L", "M.F_R")), frozenset(("M.B_L", "M.B_R"))}
    return reshaped(plain_box(half, height), lean, fixed=ends)


def opening(mechanism: Mechanism) -> BasePatchPair:
    """The first opening pair that a mechanism offers."""
    return next(pair for pair in mechanism.pairs() if pair.kind is PairKind.OPENING)


def corners(mechanism: Mechanism) -> list[BasePatchPair]:
    """The corner pairs that a mechanism offers."""
    return [pair for pair in mechanism.pairs() if pair.kind is PairKind.CORNER]


def scaled(design: Design, factor: float) -> Design:
    """The same design at another size."""

    def points(ring: Iterable[Iterable[float]]) -> tuple[tuple[float, ...], ...]:
        return tuple(tuple(factor * value for value in point) for point in ring)

    card = design.card
    update = {
        "card": Card(x=(factor * card.x[0], factor * card.x[1]), depth=factor * card.depth),
        "mechanisms": (),
        "patches": tuple(p.model_copy(update={"outline": points(p.outline)}) for p in design.patches),
        "hinges": tuple(h.model_copy(update={"axis": points(h.axis)}) for h in design.hinges),
    }
    return checked(design.model_copy(update=update))


def without(design: Design, patches: set[str]) -> Design:
    """A design without some patches, their hinges, and all names of mechanisms."""
    update = {
        "mechanisms": (),
        "patches": tuple(
            patch.model_copy(update={"mechanism": None}) for patch in design.patches if patch.id not in patches
        ),
        "hinges": tuple(hinge for hinge in design.hinges if not patches.intersection(hinge.patches)),
    }
    return checked(design.model_copy(update=update))


def reshaped(design: Design, move: Callable[[str, np.ndarray], np.ndarray], fixed: set[frozenset[str]]) -> Design:
    """Corners and axis ends moved by `move(patch or "", point)`; hinges of `fixed` pairs stay.

    Creases between patches that are no longer in one plane are dropped.
    """

    def ring(name: str, points: Iterable[Iterable[float]]) -> tuple[tuple[float, ...], ...]:
        return tuple(tuple(map(float, move(name, np.array(point)))) for point in points)

    patches = {p.id: p.model_copy(update={"outline": ring(p.id, p.outline)}) for p in design.patches}
    fresh = {name: type(patch)(**patch.model_dump()) for name, patch in patches.items()}
    hinges = []
    for hinge in design.hinges:
        axis = hinge.axis if frozenset(hinge.patches) in fixed else ring("", hinge.axis)
        first, second = (fresh[name].plane.normal for name in hinge.patches)
        flat = 1 - abs(first @ second) < 1e-6
        hinges.append(hinge.model_copy(update={"axis": axis, "crease": hinge.crease if flat else None}))
    return checked(design.model_copy(update={"patches": tuple(fresh.values()), "hinges": tuple(hinges)}))


def checked(design: Design) -> Design:
    """The design as a file would give it: everything derived anew, all rules checked."""
    return parse_design(dump_design(design))


def _ridge(total: float, out: float, height: float) -> float:
    """Height c of the backbone with c + |(out, height) - (0, c)| = total."""
    low, high = 0.0, total
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if middle + np.hypot(out, height - middle) < total else (low, middle)
    return low
