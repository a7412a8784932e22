"""On real models, prints lie where the model has its colours: both are seen in the same views and compared."""

import numpy as np
import pytest

from popsim.design import Card
from popsim.geometry.surface import Surface
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mesh.loading import load_model
from popsim.patches import PatchSettings, paint
from popsim.patches.popup_surface import popup_surface
from popsim.pipeline.run import run_design
from popsim.pipeline.settings import RunSettings
from popsim.rendering.maps import render_maps
from popsim.rendering.view import View

LENGTH = 150.0
ALLOWED = 0.08
"""Mean difference of colours over the pixels that both cover, of 1."""

VIEWS = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
TEXTURED = ["ambulance_missing_tex/ambulance.obj", "law_office/law_office.obj", "house_garage/house_3.obj"]


def standing(surface: Surface, up: int) -> Surface:
    """A model with its longer side along x, on the fold, as long as LENGTH; `up` is its axis that points up."""
    low, high = surface.bounds
    level = sorted((axis for axis in range(3) if axis != up), key=lambda axis: low[axis] - high[axis])
    turn = np.eye(3)[[*level, up]]
    turn[1] *= np.linalg.det(turn)
    placed = np.eye(4)
    placed[:3, :3] = turn * LENGTH / float((high - low).max())
    low, high = surface.transformed(placed).bounds
    placed[:3, 3] = [*-(low + high)[:2] / 2, -low[2]]
    return surface.transformed(placed)


def grown(bounds, by):
    """A box (2, 3) with a margin."""
    return np.array([bounds[0] - by, bounds[1] + by])


def registration(model: Surface) -> float:
    """Mean colour difference between a model and the box-fold around it."""
    (x, y, z) = model.bounds[1]
    card = Card(x=(-2 * x, 2 * x), depth=3 * (y + z))
    box = BoxFold.plain("M1", card_pair(card), y, z, (-x, x))
    painted = paint([box], model, {"M1": grown(model.bounds, 1.0)}, PatchSettings(dpi=100))
    design = assemble(card, [box], painted.shapes)
    return apart(model, popup_surface(design, painted.images, pages=False))


def apart(model: Surface, popup: Surface) -> float:
    """Mean colour difference between a model and a pop-up in the same frame, over all views, of 1."""
    found = []
    for eye in VIEWS:
        up = (1, 0, 0) if eye[2] else (0, 0, 1)
        view = View.framing(model.triangles.reshape(-1, 3), eye=eye, up=up, pixels_per_unit=2)
        one, two = (render_maps(surface, view, shading="flat") for surface in (model, popup))
        both = one.mask & two.mask
        assert both.sum() > 0.5 * one.mask.sum()
        found.append(np.abs(one.colour[both, :3].astype(float) - two.colour[both, :3]).mean() / 255)
    return float(np.mean(found))


@pytest.mark.parametrize("name", TEXTURED)
def test_prints_of_real_models_lie_where_their_colours_are(shared_meshes, name):
    assert registration(standing(load_model(shared_meshes / name).surface, up=2)) < ALLOWED


def test_prints_of_the_truck_lie_where_its_colours_are(models):
    truck = load_model(models / "truck" / "truck.obj").surface
    assert registration(standing(truck, up=1)) < ALLOWED


def test_prints_of_a_whole_design_lie_where_the_colours_of_the_model_are(models):
    """The town hall's own design, with all its steps, roofs and fins."""
    run = run_design(models / "town_hall" / "town_hall.obj", RunSettings(patches=PatchSettings(dpi=100)))
    popup = popup_surface(run.design, run.painted.images, pages=False)
    assert apart(run.prepared.surface, popup) < ALLOWED
    moved = np.eye(4)
    moved[0, 3] = 4.0
    assert apart(run.prepared.surface, popup.transformed(moved)) > ALLOWED / 2  # and the measure would notice


def test_the_measure_notices_a_print_that_is_off_by_millimetres(models):
    """Negative control: mirrored prints are far off."""
    truck = standing(load_model(models / "truck" / "truck.obj").surface, up=1)
    view = View.framing(truck.triangles.reshape(-1, 3), eye=(0, 1, 0), up=(0, 0, 1), pixels_per_unit=2)
    maps = render_maps(truck, view, shading="flat")
    both = maps.mask & maps.mask[:, ::-1]
    apart = np.abs(maps.colour[both, :3].astype(float) - maps.colour[:, ::-1][both, :3]).mean() / 255
    assert apart > ALLOWED
