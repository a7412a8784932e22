"""How large the model becomes: on the smallest card, on a card that is given, and at a scale."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from popsim.cli.choices import USUAL_SIZE, chosen_size
from popsim.errors import InputError
from popsim.layout.errors import LayoutError
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.patches import PatchSettings
from popsim.pipeline import RunSettings, run_design
from popsim.pipeline.page import MARGIN, Page, fitting_card, given_pages, needed_page, reached
from popsim.pipeline.prepare import Scale, Stance, prepare
from popsim.pipeline.wishes import Hand
from popsim.units import parse_scale

QUICK = RunSettings(patches=PatchSettings(dpi=50))


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("models") / "block.stl"
    trimesh.creation.box([60, 30, 20]).export(path)
    return path


def box(half_width: float, height: float, length: float) -> BoxFold:
    wide = card_pair(fitting_card([], page=Page(1e4, 1e4)))
    return BoxFold.plain("M1", wide, half_width, height, (-length / 2, length / 2))


def test_closed_box_says_how_large_its_page_must_be() -> None:
    # Sec. 3.3.2: front and back pairs reach half_width beyond the ends; closed, it is half_width + height high
    needed = needed_page(reached([box(20, 30, 100)]))
    assert needed.along == pytest.approx(100 + 2 * 20 + 2 * MARGIN)
    assert needed.depth == pytest.approx(20 + 30 + MARGIN)
    assert needed.room(reached([box(20, 30, 100)])) == pytest.approx(1)


def test_room_is_what_a_page_leaves() -> None:
    reach = reached([box(20, 30, 100)])
    assert Page(280 + 2 * MARGIN, 500).room(reach) == pytest.approx(2)
    assert Page(500, 25 + MARGIN).room(reach) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("name", "pages"),
    [
        ("A5", {(148, 210), (210, 148)}),
        ("a5 landscape", {(210, 148)}),
        ("180x120mm", {(180, 120)}),
        ("20x15.5cm", {(200, 155)}),
    ],
)
def test_pages_of_a_card(name: str, pages: set[tuple[float, float]]) -> None:
    assert {(page.along, page.depth) for page in given_pages(name)} == pages


def test_unknown_card_is_refused_before_any_work() -> None:
    with pytest.raises(LayoutError, match="paper 'A12' is not known"):
        replace(QUICK, card="A12").check_choices()


def test_a_given_card_is_filled(block: Path) -> None:
    run = run_design(block, replace(QUICK, card="105x148mm"))
    card = run.design.card
    assert sorted((card.x[1] - card.x[0], card.depth)) == [105, 148]
    room = Page(card.x[1] - card.x[0], card.depth).room(reached(run.fit.mechanisms))
    assert 1 <= room < 1.05
    assert run.verdict.passed
    assert any(f"the model is {run.prepared.longest:.1f} mm long on it" in note for note in run.notes)


def test_a_card_too_small_for_the_size_is_refused(block: Path) -> None:
    with pytest.raises(InputError, match=r"needs a card of \d+ x \d+ mm when folded; 90x60mm has 90 x 60 mm"):
        run_design(block, replace(QUICK, card="90x60mm", size=120.0, exact_size=True))


def test_scale_makes_millimetres_of_the_files_units(block: Path) -> None:
    prepared = prepare(block, Stance(), Scale(2.5), 0)
    np.testing.assert_allclose(np.ptp(prepared.surface.bounds, axis=0), [150, 75, 50])
    metres = block.with_suffix(".glb")
    trimesh.creation.box([6, 3, 2]).export(metres)
    assert prepare(metres, Stance(), Scale(1 / 87), 0).longest == pytest.approx(6000 / 87)


def test_a_scale_that_makes_a_crumb_says_what_was_taken_for_a_unit(block: Path) -> None:
    with pytest.raises(
        InputError, match=r"at a scale of 1:87 the model, 60 units of 1 mm long, has 0\.69 mm; expected"
    ):
        prepare(block, Stance(), Scale(1 / 87), 0)


def test_rays_meet_a_scaled_scene_where_they_meet_one_built_anew(block: Path) -> None:
    prepared = prepare(block, Stance(), 150.0, 0)
    scaled, anew = prepared.scaled(0.4), prepare(block, Stance(), 60.0, 0)
    rng = np.random.default_rng(0)
    origins = rng.uniform(-20, 20, (200, 3)) + np.array([0, 0, 90])
    for scene in (scaled.scene, scaled.scene.opaque()):
        hits, wanted = (each.hit(origins, np.array([[0.1, 0.2, -1.0]]), bary=True) for each in (scene, anew.scene))
        np.testing.assert_allclose(hits.distance, wanted.distance, atol=1e-9)
        np.testing.assert_allclose(hits.bary, wanted.bary, atol=1e-9)
    np.testing.assert_allclose(scaled.to_card, anew.to_card, atol=1e-12)


@pytest.mark.parametrize(("text", "value"), [("1:87", 1 / 87), ("0.5", 0.5), ("2:1", 2), (" 1 : 4 ", 0.25)])
def test_scales(text: str, value: float) -> None:
    assert parse_scale(text, "--scale") == pytest.approx(value)


@pytest.mark.parametrize("text", ["0", "1:0", "-1:3", "half", "1:2:3", ""])
def test_no_scales(text: str) -> None:
    with pytest.raises(InputError, match=r"--scale: .* is not a scale; write for example 1:87"):
        parse_scale(text, "--scale")


def test_sizes_that_contradict_each_other_are_refused() -> None:
    assert chosen_size(None, None, Hand()) == (USUAL_SIZE, False)
    assert chosen_size("12cm", None, Hand()) == (120.0, True)
    assert chosen_size(None, "1:4", Hand()) == (Scale(0.25), True)
    assert chosen_size(None, None, Hand(size=99.0)) == chosen_size("99mm", None, Hand(size=99.0)) == (99.0, True)
    for size, scale, hand in (
        ("1cm", "1:4", Hand()),
        ("98mm", None, Hand(size=99.0)),
        (None, "1:4", Hand(size=9.0)),
    ):
        with pytest.raises(InputError, match="--size and --scale"):
            chosen_size(size, scale, hand)
