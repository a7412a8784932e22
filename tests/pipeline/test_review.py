"""What a report tells beyond the verdict: heaps, parts that no paper shows, and what hangs over the ground."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from popsim.design import Card
from popsim.fitting.appearance import Likeness
from popsim.geometry.surface import Material, Surface
from popsim.mechanisms import Mechanism, assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mesh.alignment import align
from popsim.mesh.connection import loose_share
from popsim.mesh.loading import load_model
from popsim.patches.popup_surface import popup_surface
from popsim.pipeline.review import doubts, leftovers, overhang
from popsim.rendering.ray_scene import RayScene

CARD = Card(x=(-100.0, 100.0), depth=150.0)
FAITHFUL = Likeness(0.9, 0.8, 0.1)


def boxes(*bounds: tuple[tuple[float, float, float], tuple[float, float, float]]) -> Surface:
    mesh = trimesh.util.concatenate([trimesh.creation.box(bounds=np.array(box)) for box in bounds])
    count = len(mesh.faces)
    return Surface(mesh.triangles, np.zeros((count, 3, 2)), np.zeros(count, int), (Material(np.ones(4)),))


def box_fold(half_width: float, height: float, x: tuple[float, float]) -> Mechanism:
    return BoxFold.plain("M1", card_pair(CARD), half_width, height, x)


BODY = ((-50, -20, 0), (50, 20, 40))
BODY_FOLD = box_fold(20, 40, (-50, 50))


def not_shown(surface: Surface, mechanism: Mechanism) -> tuple[str, ...]:
    paper = popup_surface(assemble(CARD, [mechanism], checked=False), {}, pages=False)
    return leftovers(RayScene(surface), paper, 100.0)


def test_all_of_a_box_is_shown() -> None:
    assert not_shown(boxes(BODY), BODY_FOLD) == ()


def test_what_lies_inside_is_no_loss() -> None:
    assert not_shown(boxes(BODY, ((-20, -10, 10), (20, 10, 25))), BODY_FOLD) == ()


def test_a_part_that_no_paper_shows_is_listed_with_its_size() -> None:
    (found,) = not_shown(boxes(BODY, ((60, -5, 0), (80, 5, 30))), BODY_FOLD)
    assert found.startswith("not shown: a part of ")
    size = [float(word) for word in found.split(" of ")[1].split(" mm")[0].split(" x ")]
    np.testing.assert_allclose(size, [20, 10, 30], atol=6)


def test_many_parts_are_counted() -> None:
    rows = [((x, y, 45), (x + 4, y + 4, 75)) for x in (-50, -30, -10, 10, 30, 46) for y in (-18, 14)]
    found = not_shown(boxes(BODY, *rows), BODY_FOLD)
    assert found[-1].startswith("not shown: 6 smaller parts, together ")


PILLAR, BAR = ((-10, -10, 0), (10, 10, 60)), ((-50, -10, 60), (50, 10, 80))
T_BOUNDS = np.array([[-50, -10, 0], [50, 10, 80]], float)


@pytest.mark.parametrize(
    ("x", "words"),
    [
        ((-10.0, 10.0), "it is shown where patches can follow it, and stands on nothing"),
        ((-50.0, 50.0), "for 100% of that, paper beneath it is a support that the model does not have"),
    ],
)
def test_a_t_shape_overhangs(x: tuple[float, float], words: str) -> None:
    (found,) = overhang(RayScene(boxes(PILLAR, BAR)), T_BOUNDS, [box_fold(10, 80, x)])
    assert "80% of the model's footprint hangs about 60 mm over the ground" in found
    assert words in found


def test_a_car_does_not_overhang() -> None:
    wheels = [((x, y, 0), (x + 15, y + 5, 15)) for x in (-40, 25) for y in (-20, 15)]
    surface = boxes(((-50, -20, 8), (50, 20, 40)), *wheels)
    assert overhang(RayScene(surface), np.array([[-50, -20, 0], [50, 20, 40]], float), [BODY_FOLD]) == ()


def test_loose_triangles_are_told_from_a_mesh() -> None:
    box = boxes(BODY)
    assert loose_share(box) == 0
    apart = box.triangles + np.arange(len(box.triangles))[:, None, None] * 0.5
    assert loose_share(Surface(apart, box.uv, box.material, box.materials)) == 1
    jitter = box.triangles + np.random.default_rng(0).normal(0, 1e-7, box.triangles.shape)
    assert loose_share(Surface(jitter, box.uv, box.material, box.materials)) == 0


def test_a_heap_of_triangles_is_designed_with_low_confidence(shared_meshes: Path, models: Path) -> None:
    soup, truck = (
        load_model(path) for path in (shared_meshes / "soup" / "soup.stl", models / "truck" / "truck.obj")
    )
    (doubt,) = doubts(soup.surface, align(soup), FAITHFUL)
    assert doubt.startswith("low confidence: the model is a heap of loose triangles (100% of its area)")
    assert doubts(truck.surface, align(truck), FAITHFUL) == ()
    (unlike,) = doubts(truck.surface, align(truck), Likeness(0.5, 0.3, 0.4))
    assert "resembles the model little (silhouette 0.50, relief 0.30 of 1)" in unlike
