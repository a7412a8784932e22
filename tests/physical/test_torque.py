"""Torque at the central fold against closed forms and against virtual work."""

import numpy as np
import pytest
from folding_designs import (
    CARD,
    CARD_PAIR,
    checked,
    layered,
    mismatched_box,
    plain_box,
    scaled,
    slanted_box,
    tower,
    wedges,
)

from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.simulation import fold_design
from popsim.simulation.physical import fold_paper
from popsim.stock import Stock

HEAVY = Stock.of(300, crease=0.0)
SPRINGY = Stock.of(200)


def springs(turned: np.ndarray, length: float, stock: Stock) -> np.ndarray:
    """Energy of a crease that stands at an angle of `turned` between its patches."""
    return stock.crease * length * (turned - np.pi / 2) ** 2 / 2


def slope(energy, theta: np.ndarray) -> np.ndarray:
    """Torque towards closing: minus the derivative of an energy."""
    step = 1e-5
    return -(energy(theta + step) - energy(theta - step)) / (2 * step)


def page(theta: np.ndarray, stock: Stock, card=CARD) -> np.ndarray:
    """Energy of the lifted page and of the central fold."""
    width = card.x[1] - card.x[0]
    weight = stock.weight * width * card.depth
    return weight * card.depth / 2 * np.sin(theta) + springs(theta, width, stock)


@pytest.mark.parametrize("stock", [HEAVY, SPRINGY], ids=["weight", "crease"])
def test_two_pages_and_one_crease_are_a_lever_and_a_spring(on_paper, stock):
    torque = on_paper(assemble(CARD, []), stock).torque
    width = CARD.x[1] - CARD.x[0]
    lever = stock.weight * width * CARD.depth**2 / 2
    stated = -lever * np.cos(torque.theta) - stock.crease * width * (torque.theta - np.pi / 2)
    assert torque.torque == pytest.approx(stated, rel=1e-9, abs=1e-9)
    assert stated[0] * stated[-1] < 0


@pytest.mark.parametrize("stock", [HEAVY, SPRINGY], ids=["weight", "crease"])
def test_tent_fold_by_virtual_work(on_paper, stock):
    base, slope_length, (low, high) = 20.0, 30.0, (-40.0, 40.0)
    width = high - low
    height = np.sqrt(slope_length**2 - base**2)
    design = assemble(CARD, [TentFold("M", CARD_PAIR, (low, high), base, height)])

    def energy(theta: np.ndarray) -> np.ndarray:
        half = theta / 2
        apex = base * np.cos(half) + np.sqrt(slope_length**2 - (base * np.sin(half)) ** 2)
        weight = stock.weight * width * slope_length
        lean = np.arctan2(base * np.sin(half), apex - base * np.cos(half))
        creases = 2 * springs(half + lean, width, stock) + springs(2 * lean, width, stock)
        return page(theta, stock) + weight * (apex + base * np.cos(half)) * np.sin(half) + creases

    torque = on_paper(design, stock).torque
    assert torque.torque == pytest.approx(slope(energy, torque.theta), rel=2e-5, abs=2e-5)


@pytest.mark.parametrize("stock", [HEAVY, SPRINGY], ids=["weight", "crease"])
def test_nested_folds_by_virtual_work_of_its_closed_form(on_paper, stock):
    """Against the poses of the theory, which know nothing of the simulation."""
    from popsim.simulation.physical.loads import Loads
    from popsim.validity import examine

    design, _ = tower()
    loads, theory = Loads(design, stock), examine(design)

    def energy(theta: np.ndarray) -> np.ndarray:
        stated = theory.poses(theta)
        poses = np.stack([stated[patch.id] for patch in design.patches], axis=1)
        return loads.energy(poses, theta)

    torque = on_paper(design, stock).torque
    inside = (torque.theta > np.radians(2)) & (torque.theta < np.radians(178))
    stated = slope(energy, torque.theta[inside])
    assert torque.torque[inside] == pytest.approx(stated, rel=1e-5, abs=1e-5)


@pytest.mark.parametrize("make", [plain_box, lambda: wedges()[0], lambda: layered()[0]])
def test_measured_torque_is_the_slope_of_the_energy_and_everything_is_at_rest(on_paper, make):
    torque = on_paper(make(), SPRINGY).torque
    greatest = np.abs(torque.torque).max()
    assert greatest > 50
    assert torque.disagreement < 1e-4 * greatest
    assert torque.unbalanced.max() < 1e-4 * greatest


@pytest.mark.parametrize("make", [lambda: slanted_box(1), lambda: mismatched_box(0.1)])
def test_play_is_no_force(on_paper, make):
    """Loops that stay open by a tenth of a millimetre pull at nothing: what gives way there is not known."""
    torque = on_paper(make(), SPRINGY).torque
    assert torque.disagreement < 0.01 * np.abs(torque.torque).max()
    inside = (torque.theta > np.radians(10)) & (torque.theta < np.radians(170))
    assert torque.unbalanced[inside].max() < 1e-3


def test_torque_without_paper_is_nothing_and_grows_with_the_paper(on_paper):
    box = plain_box()
    light, heavy = (on_paper(box, Stock.of(grammage, crease=0.0)).torque.torque for grammage in (100, 200))
    assert heavy == pytest.approx(2 * light, rel=1e-6)
    limp, stiff = (on_paper(box, Stock.of(200, crease=crease)).torque.torque for crease in (0.1, 0.3))
    none = on_paper(box, Stock.of(200, crease=0.0)).torque.torque
    assert stiff - none == pytest.approx(3 * (limp - none), rel=1e-4, abs=1e-4)


def test_weight_goes_with_the_cube_of_the_size_and_creases_with_its_length(on_paper):
    small, large = plain_box(), scaled(plain_box(), 2.0)
    by_weight = [on_paper(design, HEAVY).torque.torque for design in (small, large)]
    assert by_weight[1] == pytest.approx(8 * by_weight[0], rel=1e-5)
    weightless = Stock.of(30, thickness=0.1, crease=10.0)
    bare = Stock.of(30, thickness=0.1, crease=0.0)
    by_crease = [
        on_paper(design, weightless).torque.torque - on_paper(design, bare).torque.torque
        for design in (small, large)
    ]
    assert by_crease[1] == pytest.approx(2 * by_crease[0], rel=1e-5)


def test_weights_are_carried_to_the_pages(on_paper):
    from popsim.simulation.physical.loads import Loads, gravity
    from popsim.simulation.physical.statics import balance

    design, _ = tower()
    folding = fold_design(design, 180)
    loads = Loads(design, SPRINGY)
    (frame,) = folding.sweep.closing_at([120])
    poses, theta = folding.sweep.poses[[frame]], folding.sweep.theta[[frame]]
    with folding.rig.without_preloads():
        measured = balance(folding.rig, folding.sweep, frame, loads.wrenches(poses, theta)[0])
    on_pages = np.zeros(3)
    for page_id in ("G", "B"):
        for hinge in design.hinges_by_patch[page_id]:
            if hinge.kind != "central":
                sign = 1 if hinge.patches[0] == page_id else -1
                on_pages += sign * measured.forces[hinge.id]
    pages = [index for index, patch in enumerate(design.patches) if patch.id in ("G", "B")]
    above = loads.weights.sum() - loads.weights[pages].sum()
    assert on_pages == pytest.approx(above * gravity(theta)[0], abs=1e-6)


def test_holes_weigh_nothing():
    from popsim.simulation.physical.loads import Loads

    design = plain_box()
    hole = ((-5.0, 60.0, 0.0), (5.0, 60.0, 0.0), (5.0, 80.0, 0.0), (-5.0, 80.0, 0.0))
    pierced = [
        patch.model_copy(update={"holes": (hole,)}) if patch.id == "G" else patch for patch in design.patches
    ]
    other = checked(design.model_copy(update={"patches": tuple(pierced)}))
    whole, open_ = (Loads(each, SPRINGY).areas[0] for each in (design, other))
    assert whole - open_ == pytest.approx(200)


def test_measuring_leaves_the_rig_as_it_was():
    design = plain_box()
    folding = fold_design(design, 180)
    before = folding.rig.model.jnt_stiffness.copy()
    first = fold_paper(folding.rig, folding.sweep, SPRINGY)
    assert (folding.rig.model.jnt_stiffness == before).all() and before.any()
    again = fold_paper(folding.rig, folding.sweep, SPRINGY)
    assert (first.torque.torque == again.torque.torque).all()


def test_step_on_a_box_is_part_of_the_torque(on_paper):
    from folding_designs import corners

    from popsim.mechanisms.box_fold import BoxFold

    pair = card_pair(CARD)
    box = BoxFold.plain("M", pair, 40, 40, (-40, 40))
    step = StepFold("S", corners(box)[0], (-30, 30), 20, 20)
    plain, stepped = (on_paper(assemble(CARD, parts), SPRINGY) for parts in ([box], [box, step]))
    assert stepped.weight - plain.weight == pytest.approx(SPRINGY.weight * 60 * 40)
    assert np.abs(stepped.torque.torque - plain.torque.torque).max() > 1
