"""Rows of pictures: the model, the pop-up at fold angles, each from every view."""

import numpy as np
import pytest

from popsim.design import Card, Design, dump_design
from popsim.errors import InputError
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.pictures import Look, open_picture, picture_strip
from popsim.pictures.photo import backdrop
from popsim.rendering.contact_sheet import CAPTION, GAP

CARD = Card(x=(-60.0, 60.0), depth=80.0)
SMALL = Look(width=96, height=72)
BLOCK = [(x, y, z) for x in (-30, 30) for y in (-20, 20) for z in (0, 25)]
FACES = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A block, as a model and as a design without prints."""
    path = tmp_path_factory.mktemp("strip")
    lines = [f"v {x} {y} {z}" for x, y, z in BLOCK]
    (path / "block.obj").write_text("\n".join([*lines, *(f"f {a} {b} {c} {d}" for a, b, c, d in FACES)]) + "\n")
    stay = tuple(tuple(float(i == k) for k in range(4)) for i in range(4))
    box = BoxFold.plain("M1", card_pair(CARD), 20.0, 25.0, (-30.0, 30.0))
    (path / "design.json").write_text(dump_design(assemble(CARD, [box], model_to_card=stay)))
    return path


@pytest.fixture(scope="module")
def design(folder) -> Design:
    from popsim.design import load_design

    return load_design(folder / "design.json")


def cells(strip, columns, rows, look=SMALL):
    """The pictures of a strip, row by row."""
    high, wide = look.height + 2 * CAPTION + GAP, look.width + GAP
    assert strip.shape == (rows * high + GAP, columns * wide + GAP, 4)
    return [
        strip[GAP + r * high : GAP + r * high + look.height, GAP + c * wide : GAP + c * wide + look.width, :3]
        for r in range(rows)
        for c in range(columns)
    ]


def test_model_and_pop_up_stand_at_the_same_place_in_every_view(folder, design):
    looks = [SMALL, Look(azimuth=120, elevation=40, width=96, height=72)]
    strip = picture_strip(design, folder, [180.0], looks=looks, model=folder / "block.obj")
    pictures = cells(strip, 2, 2)
    for model, popup in (pictures[:2], pictures[2:]):
        apart = np.abs(model.astype(int) - popup).max(axis=2)
        middle = apart[26:36, 44:54]
        assert np.median(middle) < 30  # paper beside paper
    assert np.abs(pictures[1].astype(int) - pictures[3]).mean() > 2


def test_a_closing_card_lies_on_its_ground_page(folder, design):
    from popsim.patches.popup_surface import popup_surface
    from popsim.pictures.strip import _laid, _poses

    (poses,) = _poses(design, [90.0])
    page = design.model_copy(update={"patches": design.patches[:1]})
    ground = _laid(popup_surface(page, folder, poses), 90.0).triangles
    assert np.abs(ground[..., 2]).max() < 1e-6
    assert ground[..., 1].max() == pytest.approx(80.0, abs=1e-6)


def test_angles_out_of_range_and_models_without_a_place_are_refused(folder, design):
    with pytest.raises(InputError, match="181"):
        picture_strip(design, folder, [181.0], looks=[SMALL])
    nowhere = design.model_copy(update={"model_to_card": None})
    with pytest.raises(InputError, match="model_to_card"):
        picture_strip(nowhere, folder, [180.0], looks=[SMALL], model=folder / "block.obj")
    with pytest.raises(InputError, match="16 to 8000"):
        Look(width=3)


def test_an_open_picture_shows_the_card_before_a_backdrop(folder, design):
    picture = open_picture(design, folder, SMALL)
    assert picture.shape == (72, 96, 4) and (picture[..., 3] == 255).all()
    assert (picture[0, 0] == backdrop(SMALL)[0, 0]).all()
    assert np.abs(picture[40, 48, :3].astype(int) - backdrop(SMALL)[40, 48, :3]).max() > 5
