"""The front: the custom of the format, overruled where the shape speaks loudly."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from mesh_solids import boxes_mesh, model_of, truck_mesh, turn

from popsim.geometry.arrays import FloatArray
from popsim.mesh.alignment import Alignment, align
from popsim.mesh.formats import FORMATS, NO_CUSTOM
from popsim.mesh.loading import load_model

X, Y, Z = np.eye(3)
FRONT_TO_Z = turn(Y, -90) @ turn(X, -90)  # the truck stands along y, its lower end at +z
FRONT_TO_MINUS_Z = turn(Y, 180) @ FRONT_TO_Z
DEFINED = [suffix for suffix, known in FORMATS.items() if known.front > 0.9]
FREE = [suffix for suffix, known in FORMATS.items() if known.front == NO_CUSTOM]


def found(matrix: FloatArray, suffix: str, mesh: trimesh.Trimesh | None = None, up: str = "y") -> Alignment:
    return align(model_of(truck_mesh() if mesh is None else mesh, matrix, suffix), up=up)


def low_end_ahead(found: Alignment, matrix: FloatArray) -> float:
    """Cosine between the front that was found and the lower end of the truck."""
    return float((found.matrix @ matrix)[0, 0])


def test_formats_with_a_defined_front() -> None:
    assert DEFINED == [".glb", ".gltf"]
    assert NO_CUSTOM < FORMATS[".obj"].front < 0.8


@pytest.mark.parametrize("suffix", DEFINED)
def test_the_front_of_a_gltf_is_z_whichever_end_is_lower(suffix: str) -> None:
    against, agrees = (found(matrix, suffix) for matrix in (FRONT_TO_MINUS_Z, FRONT_TO_Z))
    assert against.axes == agrees.axes == ("z", "x", "y")
    assert "z is the front, as is usual for the format, although the lower end is the other" in against.reasons[3]
    assert 0.5 < against.front_confidence < 0.95 < agrees.front_confidence
    assert f"(confidence {against.front_confidence:.2f})" in against.reasons[3]


@pytest.mark.parametrize("suffix", FREE)
@pytest.mark.parametrize("matrix", [FRONT_TO_Z, FRONT_TO_MINUS_Z])
def test_without_a_custom_the_lower_end_is_the_front(matrix: FloatArray, suffix: str) -> None:
    seen = found(matrix, suffix)
    assert low_end_ahead(seen, matrix) == pytest.approx(1)
    assert seen.reasons[3].startswith("the lower end is the front (confidence ")


def test_a_loud_shape_overrules_the_custom() -> None:
    # a low block far ahead of a high one
    mesh = boxes_mesh([((3, -1, 0), (4, 1, 1)), ((0, -0.1, 0), (3, 0.1, 0.1)), ((-1, -1, 0), (0, 1, 0.1))])
    mesh += boxes_mesh([((-1, -1, 8), (0, 1, 9)), ((-0.6, -0.1, 0.1), (-0.4, 0.1, 8))])
    seen = found(FRONT_TO_MINUS_Z, ".glb", mesh)
    assert seen.axes[0] == "-z"
    assert "the lower end is the front, although z is usual for the format" in seen.reasons[3]


def test_the_habit_of_an_obj_decides_where_the_shape_says_little() -> None:
    steep = boxes_mesh([((0, -1, 0), (4, 1, 0.4)), ((-4, -1, 0), (0, 1, 5))])
    assert found(FRONT_TO_MINUS_Z, ".obj", steep).axes[0] == "-z"
    assert found(FRONT_TO_MINUS_Z, ".glb", steep).axes[0] == "z"
    nearly = boxes_mesh([((-2, -1, 0), (2, 1, 1)), ((1.9, -0.2, 0.4), (2.03, 0.2, 0.6))])
    for matrix in (FRONT_TO_Z, FRONT_TO_MINUS_Z):
        seen = found(matrix, ".obj", nearly)
        assert seen.axes[0] == "z"
        assert "both ends look alike; the one towards z is the front" in seen.reasons[3]
        assert low_end_ahead(found(matrix, ".stl", nearly), matrix) == pytest.approx(-1)


def test_an_obj_that_stands_along_z_has_no_usual_front() -> None:
    seen = found(np.eye(4), ".obj", up="z")
    assert seen.axes[0] == "x"
    assert "where y is not up, the format does not tell" in seen.reasons[3]


@pytest.mark.parametrize("degrees", [0, 180])
def test_a_gltf_that_is_built_along_x_has_its_lower_end_ahead(degrees: float) -> None:
    matrix = turn(Y, degrees) @ turn(X, -90)
    seen = found(matrix, ".glb")
    assert low_end_ahead(seen, matrix) == pytest.approx(1)
    assert "z, the usual front of the format, is neither end" in seen.reasons[3]


@pytest.mark.parametrize("degrees", [0, 180])
def test_a_house_that_stands_along_x_shows_the_viewer_its_front(degrees: float) -> None:
    house = boxes_mesh([((-5, -1, 0), (5, 1, 3)), ((-1, -1.5, 0), (1, -1, 2))])  # a porch before the middle
    matrix = turn(Y, degrees) @ turn(X, -90)
    seen = found(matrix, ".glb", house)
    assert seen.axes == ("-x", "z", "y")
    assert "both ends look alike; the side towards z is the front, as is usual for the format" in seen.reasons[3]


@pytest.mark.parametrize(("degrees", "ahead"), [(10, -1), (-20, -1), (50, 1), (-60, 1)])
def test_the_custom_fades_as_the_model_turns_from_its_axes(degrees: float, ahead: float) -> None:
    matrix = turn(Y, degrees) @ FRONT_TO_MINUS_Z
    assert low_end_ahead(found(matrix, ".glb"), matrix) == pytest.approx(ahead, abs=1e-3)


@pytest.mark.parametrize("turned", [turn(X, 90), turn(Z, -90), turn([1, 2, 3], 80), turn([1, 0, -2], 140)])
def test_a_gltf_that_lies_anyhow_stands_as_its_shape_has_it(turned: FloatArray) -> None:
    matrix = turned @ FRONT_TO_MINUS_Z
    seen = found(matrix, ".glb", up=",".join(repr(float(part)) for part in turned[:3, 1]))
    assert low_end_ahead(seen, matrix) == pytest.approx(1, abs=1e-6)


def test_what_the_user_states_does_not_depend_on_how_the_model_lies() -> None:
    upright = model_of(truck_mesh(), FRONT_TO_MINUS_Z, ".glb")
    for degrees in (0, 77, 180):
        turned = turn([1, 2, 3], degrees)
        lies = replace(upright, surface=upright.surface.transformed(turned))
        up, front = (",".join(repr(float(part)) for part in turned[:3, k]) for k in (1, 2))
        seen = align(lies, up=up, front=front)
        np.testing.assert_allclose(seen.matrix @ turned, align(upright, front="z").matrix, atol=1e-6)
        assert seen.front_confidence == 1


@pytest.mark.parametrize(
    ("name", "front"),
    [
        ("milk_truck/CesiumMilkTruck.glb", "x"),
        ("taxi/car_taxi.gltf", "z"),
        ("toy_truck_yellow/vehicle-truck-yellow.glb", "z"),
        ("sail_ship/q_sail_ship.glb", "z"),
        ("cruise_ship/q_cruise_ship.obj", "z"),
        ("delivery_truck/delivery.obj", "z"),
        ("bank_town_hall/qb_bank.obj", "z"),
        ("church/building_church_red.obj", "z"),
        ("ambulance_missing_tex/ambulance.obj", "-y"),
        ("suv_hummer/suv.obj", "y"),
    ],
)
def test_fronts_of_real_models(name: str, front: str, shared_meshes: Path) -> None:
    assert align(load_model(shared_meshes / name)).axes[0] == front
