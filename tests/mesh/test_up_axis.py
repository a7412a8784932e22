"""The up axis: the custom of the format, overruled where the shape speaks."""

from pathlib import Path

import numpy as np
import pytest
import trimesh
from mesh_solids import boxes_mesh, model_of, shift, truck_mesh, turn

from popsim.errors import MeshError
from popsim.geometry.arrays import FloatArray
from popsim.mesh.axes import UP_AXES
from popsim.mesh.formats import FORMATS
from popsim.mesh.loading import load_model
from popsim.mesh.sampling import sample_surface
from popsim.mesh.up_axis import UpChoice, choose_up, stated_up

X, Y = np.eye(3)[:2]
TO_Y_UP = turn(X, -90)
LEAST_RIGHT = 26
"""Of the 27 real models; one is a ball and one a heap of triangles, where up is a matter of taste."""


def chosen(mesh: trimesh.Trimesh, matrix: FloatArray, suffix: str) -> UpChoice:
    surface = model_of(mesh, matrix, suffix).surface
    return choose_up(surface, sample_surface(surface, 2000, seed=0), FORMATS[suffix].up)


def known_models(folder: Path) -> list[tuple[Path, str]]:
    """Files and up axes of the index of real models."""
    found = []
    for line in (folder / "INDEX.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) > 13 and cells[12] in ("X", "Y", "Z"):
            found.append((folder / cells[1] / cells[3], cells[12].lower()))
    return found


def test_real_models(shared_meshes: Path) -> None:
    models = known_models(shared_meshes)
    assert len(models) == 27
    wrong = []
    for path, up in models:
        surface = load_model(path).surface
        choice = choose_up(surface, sample_surface(surface, 1500, seed=0), FORMATS[path.suffix.lower()].up)
        if choice.name != up:
            wrong.append(f"{path.name}: {choice.name} instead of {up}, {choice.confidence:.2f}: {choice.reason}")
    assert len(models) - len(wrong) >= LEAST_RIGHT, wrong


@pytest.mark.parametrize(("matrix", "up"), [(np.eye(4), "z"), (TO_Y_UP, "y")])
def test_obj_has_no_rule_so_the_shape_decides(matrix: FloatArray, up: str) -> None:
    choice = chosen(truck_mesh(), matrix, ".obj")
    assert choice.name == up
    assert choice.confidence > 0.9
    assert "the model stands on the origin" in choice.reason


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_cube_follows_the_custom_of_its_format(suffix: str) -> None:
    choice = chosen(trimesh.creation.box([1, 1, 1]), np.eye(4), suffix)
    assert choice.name == max(FORMATS[suffix].up, key=lambda axis: FORMATS[suffix].up[axis])
    assert "as is usual" in choice.reason


def test_strong_evidence_overrules_the_custom() -> None:
    pyramid = boxes_mesh([((-4 + k, -4 + k, k), (4 - k, 4 - k, k + 1)) for k in range(4)])
    choice = chosen(pyramid, TO_Y_UP, ".stl")
    assert choice.name == "y"
    assert "although z is usual" in choice.reason


def test_a_doubtful_shape_has_less_confidence_than_a_clear_one() -> None:
    clear = chosen(truck_mesh(), np.eye(4), ".obj")
    doubtful = chosen(trimesh.creation.icosphere(3), np.eye(4), ".obj")
    assert doubtful.confidence < 0.75 < clear.confidence


def test_an_askew_truck_is_set_upright() -> None:
    matrix = shift(3, 2, 1) @ turn(np.array([1.0, 2.0, 0.5]), 25)
    choice = chosen(truck_mesh(), matrix, ".stl")
    assert choice.name == "askew"
    np.testing.assert_allclose(choice.direction, matrix[:3, 2], atol=1e-3)


@pytest.mark.parametrize("name", UP_AXES)
def test_the_option_names_an_axis(name: str) -> None:
    choice = stated_up(name)
    assert choice.name == name
    assert choice.confidence == 1
    assert choice.direction["xyz".index(name[-1])] == (-1 if name.startswith("-") else 1)


def test_the_option_states_any_direction() -> None:
    choice = stated_up("0, 3, 4")
    assert choice.name == "askew"
    np.testing.assert_allclose(choice.direction, [0, 0.6, 0.8])
    assert stated_up("0,2,0.01").name == "y"


@pytest.mark.parametrize("text", ["up", "1,2", "0,0,0", "1,nan,2", "1,inf,0", "x,y,z", ""])
def test_unknown_option(text: str) -> None:
    with pytest.raises(MeshError, match=f"up: '{text}' is no direction; expected one of x, -x"):
        stated_up(text)
