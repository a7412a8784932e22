"""Galleries hang models beside their pop-ups, and say which have none."""

import numpy as np
import pytest

from popsim.errors import InputError
from popsim.pictures import Look
from popsim.pipeline.gallery import Exhibit, exhibit, exhibits, find_models, hang

SMALL = Look(width=64, height=48)
FACES = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"


@pytest.fixture
def block(tmp_path):
    corners = [(x, y, z) for x in (0, 60) for y in (0, 40) for z in (0, 30)]
    path = tmp_path / "block.obj"
    path.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) + FACES)
    return path


def test_models_are_found_in_folders_and_named_alone(tmp_path):
    for name in ("b/two.stl", "b/two.png", "a/one.OBJ", "three.glb"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    found = find_models([tmp_path / "b", tmp_path])
    assert [path.name for path in found] == ["two.stl", "one.OBJ", "three.glb"]
    assert find_models([tmp_path / "three.glb"]) == [tmp_path / "three.glb"]


def test_places_without_models_are_refused(tmp_path):
    with pytest.raises(InputError, match="no model"):
        find_models([tmp_path])
    with pytest.raises(InputError, match="does not exist"):
        find_models([tmp_path / "nowhere"])


def test_a_model_hangs_beside_its_pop_up(block):
    shown = exhibit(block, SMALL)
    assert shown.picture is not None and shown.picture.shape == (48, 128, 4)
    assert shown.caption.startswith("block: ") and shown.caption.endswith("patches")
    model, popup = shown.picture[:, :64, :3].astype(int), shown.picture[:, 64:, :3]
    assert np.abs(model - popup)[20:28, 28:36].mean() < 40


def test_what_has_no_pop_up_says_why_and_is_not_hung(tmp_path):
    flat = tmp_path / "flat.obj"
    flat.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (shown,) = exhibits([flat], jobs=1)
    assert shown.picture is None and shown.caption.startswith("flat: ")
    with pytest.raises(InputError, match="no pop-up"):
        hang([shown], 2)
    picture = np.zeros((10, 20, 4), np.uint8)
    assert (
        hang([shown, Exhibit(flat, picture, "one")], 2).shape[1] == hang([Exhibit(flat, picture, "")], 1).shape[1]
    )


def test_a_gallery_needs_a_process(block):
    with pytest.raises(InputError, match="jobs"):
        list(exhibits([block], jobs=0))
