"""On real models, outlines follow the contours of the model wherever no rule moves them."""

import numpy as np
import pytest
from contours import departures
from test_registration import grown, standing

from popsim.design import Card
from popsim.fitting import FitSettings
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mesh.loading import load_model
from popsim.patches import PatchSettings
from popsim.pipeline.abstract import abstract
from popsim.pipeline.prepare import Stance, prepare
from popsim.pipeline.territory import territories
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
    ("sail_ship/q_sail_ship.glb", 1),
    ("ambulance_missing_tex/ambulance.obj", 1),
    ("cruise_ship/q_cruise_ship.obj", 1),
    ("toy_truck_yellow/vehicle-truck-yellow.glb", 1),
    ("suv_hummer/suv.obj", 1),
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


@pytest.mark.parametrize("name", ["taxi/car_taxi.gltf", "radio_tower/radio_tower.obj", "suv_hummer/suv.obj"])
def test_so_do_those_of_whole_designs(shared_meshes, monkeypatch, name):
    prepared = prepare(shared_meshes / name, Stance(), 150.0, 0)
    fit = abstract(prepared, FitSettings(), 0)
    boxes = territories(fit.mechanisms, prepared.bounds)
    found = departures(fit.mechanisms, prepared.scene, boxes, PatchSettings(), monkeypatch, fit.depths)
    assert len(found) > 5
    for way in ("outward", "back"):
        distances = np.concatenate([getattr(each, way) for each in found])
        assert len(distances) > 200
        assert distances.max() < ALLOWED


def test_the_measure_notices_outlines_that_are_simplified_too_much(shared_meshes, monkeypatch):
    """Negative control."""
    model = standing(load_model(shared_meshes / "taxi/car_taxi.gltf").surface, up=1)
    coarse = PatchSettings(tolerance=3.0)
    assert max(distances.max() for distances in measured(model, monkeypatch, coarse)) > ALLOWED
