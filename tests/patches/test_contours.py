"""On real models, outlines follow the contours of the model wherever no rule moves them."""

import numpy as np
import pytest
from contours import departures
from test_registration import grown, standing

from popsim.design import Card
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mesh.loading import load_model
from popsim.patches import PatchSettings
from popsim.rendering.ray_scene import RayScene

ALLOWED = 0.5
"""mm, both ways."""

MODELS = [
    ("delivery_truck/delivery.obj", 1),
    ("milk_truck/CesiumMilkTruck.glb", 1),
    ("taxi/car_taxi.gltf", 1),
    ("castle/building_castle_red.obj", 1),
    ("church/building_church_red.obj", 1),
    ("house_garage/house_3.obj", 2),
    ("radio_tower/radio_tower.obj", 2),
]
"""And which of their axes points up."""


def measured(model, monkeypatch, settings=None):
    """Distances out and back of all patches of the box-fold around a model that is not as high as the model."""
    low, (x, y, z) = model.bounds
    card = Card(x=(-2 * x, 2 * x), depth=3 * (y + z))
    box = BoxFold.plain("M1", card_pair(card), 0.8 * y, 0.8 * z, (-0.85 * x, 0.85 * x))
    found = departures(
        [box],
        RayScene(model),
        {"M1": grown(np.array([low, (x, y, z)]), 1.0)},
        settings or PatchSettings(),
        monkeypatch,
    )
    return [np.concatenate([getattr(each, way) for each in found]) for way in ("outward", "back")]


@pytest.mark.parametrize(("name", "up"), MODELS)
def test_outlines_lie_within_half_a_millimetre_of_the_contours(shared_meshes, monkeypatch, name, up):
    model = standing(load_model(shared_meshes / name).surface, up=up)
    for distances in measured(model, monkeypatch):
        assert len(distances) > 100
        assert distances.max() < ALLOWED


def test_the_measure_notices_outlines_that_are_simplified_too_much(shared_meshes, monkeypatch):
    """Negative control."""
    model = standing(load_model(shared_meshes / "taxi/car_taxi.gltf").surface, up=1)
    coarse = PatchSettings(tolerance=3.0)
    assert max(distances.max() for distances in measured(model, monkeypatch, coarse)) > ALLOWED
