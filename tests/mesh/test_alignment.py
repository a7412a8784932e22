"""The canonical frame depends on the shape, not on how it stands in its file."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from mesh_solids import boxes_mesh, model_of, shift, truck_mesh, turn

from popsim.errors import MeshError
from popsim.geometry.arrays import FloatArray
from popsim.mesh.alignment import METHODS, Alignment, align, alignments
from popsim.mesh.loading import load_model

Z = np.array([0.0, 0.0, 1.0])
REPEATABLE = settings(derandomize=True, deadline=None, phases=(Phase.explicit, Phase.generate))
CENTRED_TRUCK = shift(0.25, 0, 0)  # its x range is -3 to 2.5


def placed(mesh: trimesh.Trimesh, found: Alignment, matrix: FloatArray | None = None) -> FloatArray:
    """Vertices of the mesh, moved by `matrix`, in the canonical frame."""
    total = found.matrix @ (np.eye(4) if matrix is None else matrix)
    return np.asarray(trimesh.transform_points(mesh.vertices, total))


def assert_canonical(points: FloatArray, found: Alignment) -> None:
    turned = found.matrix[:3, :3]
    np.testing.assert_allclose(turned @ turned.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(turned) == pytest.approx(1)
    np.testing.assert_array_equal(found.matrix[3], [0, 0, 0, 1])
    low, high = points.min(axis=0), points.max(axis=0)
    assert low[2] == pytest.approx(0, abs=1e-9)
    assert low[0] + high[0] == pytest.approx(0, abs=1e-9)
    np.testing.assert_allclose(found.box.bounds, [low, high], atol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_upright_truck_only_shifts(method: str) -> None:
    found = align(model_of(truck_mesh()), method=method)
    np.testing.assert_allclose(found.matrix, CENTRED_TRUCK, atol=1e-6)
    assert_canonical(placed(truck_mesh(), found), found)
    assert found.axes == ("x", "y", "z")
    assert found.symmetry.score > 0.97
    assert found.reasons[3].startswith("the lower end is the front (confidence ")


@settings(REPEATABLE, max_examples=6)
@given(
    degrees=st.floats(0, 360),
    offset=st.tuples(*[st.floats(-50, 50)] * 3),
    method=st.sampled_from(["npca", "edges"]),
)
def test_turned_about_the_vertical(degrees: float, offset: tuple[float, float, float], method: str) -> None:
    matrix = shift(*offset) @ turn(Z, degrees)
    found = align(model_of(truck_mesh(), matrix), up="z", method=method)
    np.testing.assert_allclose(found.matrix @ matrix, CENTRED_TRUCK, atol=5e-3)


@settings(REPEATABLE, max_examples=4)
@given(tilt=st.floats(10, 35), heading=st.floats(0, 90))
def test_askew_truck_is_found_in_space(tilt: float, heading: float) -> None:
    # less than about 5 degrees would pass for tapered walls
    around = np.array([np.cos(np.radians(heading)), np.sin(np.radians(heading)), 0.3])
    matrix = turn(around, tilt)
    found = align(model_of(truck_mesh(), matrix))
    np.testing.assert_allclose(found.matrix @ matrix, CENTRED_TRUCK, atol=1e-2)


OWN_MODELS = ("truck/truck.obj", "hotel/hotel.glb", "ship/ship.obj", "t_shape/t_shape.stl")


def any_turn(rng: np.random.Generator) -> FloatArray:
    """A rotation about any axis by any angle, all equally likely."""
    from scipy.spatial.transform import Rotation

    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.random(rng=rng).as_matrix()
    return matrix


def stated(direction: FloatArray) -> str:
    return ",".join(repr(float(part)) for part in direction)


@pytest.mark.parametrize("name", OWN_MODELS)
@pytest.mark.parametrize("seed", [0, 1])
def test_a_model_lying_askew_stands_as_the_upright_one_where_up_is_stated(
    name: str, seed: int, models: Path
) -> None:
    upright = load_model(models / name)
    matrix = any_turn(np.random.default_rng(seed)) @ shift(3, -20, 7)
    askew = replace(upright, surface=upright.surface.transformed(matrix))
    expected = align(upright)
    found = align(askew, up=stated(matrix[:3, :3] @ expected.up.direction))
    sizes = (np.ptp(bounds, axis=0) for bounds in (found.box.bounds, expected.box.bounds))
    np.testing.assert_allclose(*sizes, atol=1e-9)
    assert found.symmetry.score == pytest.approx(expected.symmetry.score, abs=0.005)
    total, wanted = found.matrix @ matrix, expected.matrix
    alike = "look alike" in " ".join(expected.reasons)  # then a half turn is as good
    half = np.diag([-1.0, -1.0, 1.0, 1.0])
    gap = min(np.abs(total - turned).max() for turned in ((wanted, half @ wanted) if alike else (wanted,)))
    assert gap < 1e-4


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_model_lying_anyhow_is_set_on_one_of_its_sides(seed: int, models: Path) -> None:
    upright = load_model(models / "hotel" / "hotel.glb")
    matrix = any_turn(np.random.default_rng(seed))
    found = align(replace(upright, surface=upright.surface.transformed(matrix)))
    total = np.abs(found.matrix @ matrix)[:3, :3]
    np.testing.assert_allclose(np.sort(total, axis=1), [[0, 0, 1]] * 3, atol=1e-3)
    assert found.up.confidence < align(upright, up="y").up.confidence == 1.0
    assert "stands askew in its file" in found.reasons[0]


@pytest.mark.parametrize("degrees", [0, 30, -45, 120])
def test_the_user_may_turn_the_model(degrees: float) -> None:
    found = align(model_of(truck_mesh()), up="z", method=f"{degrees}deg", front=stated(turn(Z, degrees)[:3, 0]))
    np.testing.assert_allclose(found.matrix[0, :3], turn(Z, degrees)[:3, 0], atol=1e-12)
    assert found.heading_confidence == 1
    assert f"turned by {degrees}deg" in found.reasons[1]


def test_method_none_keeps_the_model_axes() -> None:
    found = align(model_of(truck_mesh(), turn(Z, 30)), method="none")
    assert set(np.abs(found.matrix[:3, :3]).ravel()) == {0.0, 1.0}


def test_fold_lies_in_an_off_centre_mirror_plane() -> None:
    mast = [((0.0, 1.0, 0.6), (0.1, 3.0, 0.7)), ((0.0, 3.0, 0.6), (0.1, 3.1, 1.5))]
    mesh = trimesh.util.concatenate([truck_mesh(), boxes_mesh(mast)])
    found = align(model_of(mesh), up="z")
    np.testing.assert_allclose(found.matrix[:3, 3], [0.25, 0, 0], atol=0.02)
    assert not found.symmetry.centred


@pytest.mark.parametrize(("fold", "along"), [("auto", "y"), ("long", "y"), ("short", "x")])
def test_fold_of_a_block_with_two_mirror_planes(fold: str, along: str) -> None:
    found = align(model_of(trimesh.creation.box([2, 5, 1])), up="z", fold=fold)
    assert found.axes[0] == along


def test_both_folds_are_open_where_both_planes_mirror() -> None:
    block = model_of(trimesh.creation.box([2, 5, 1]))
    first, second = alignments(block, up="z")
    assert (first.axes[0], first.fold, second.axes[0], second.fold) == ("y", "long", "x", "short")
    np.testing.assert_array_equal(first.matrix, align(block, up="z").matrix)
    np.testing.assert_array_equal(second.matrix, align(block, up="z", fold="short").matrix)
    assert "where the pop-up shows more of the model; mirror score 1.00 of 1" in second.reasons[2]


@pytest.mark.parametrize("options", [{"fold": "long"}, {"fold": "short"}, {"front": "x"}])
def test_a_fold_that_is_stated_is_not_open(options: dict[str, str]) -> None:
    assert len(alignments(model_of(trimesh.creation.box([2, 5, 1])), up="z", **options)) == 1


def test_nor_is_one_that_the_mirror_decides() -> None:
    (found,) = alignments(model_of(truck_mesh()), up="z")
    assert found.fold == "long"


def test_a_longer_side_opens_it() -> None:
    # an L seen from above, longer across its mirror plane than along it
    mesh = boxes_mesh([((-4, 0, 0), (4, 1, 1)), ((-0.5, 1, 0), (0.5, 3, 2))])
    assert [found.fold for found in alignments(model_of(mesh), up="z")] == ["short", "long"]


def test_the_better_mirror_plane_beats_the_longer_side() -> None:
    # an L seen from above, longer across its mirror plane x = 0 than along it
    mesh = boxes_mesh([((-4, 0, 0), (4, 1, 1)), ((-0.5, 1, 0), (0.5, 3, 2))])
    found = align(model_of(mesh), up="z")
    assert found.axes[0].endswith("y")
    np.testing.assert_allclose(found.matrix[1, 3], 0, atol=1e-2)


def test_without_a_mirror_plane_the_fold_runs_along_the_longer_side(shared_meshes: Path) -> None:
    found = align(load_model(shared_meshes / "bunny" / "bunny.obj"))
    assert found.symmetry.score < 0.5
    assert found.axes[0].endswith("x")


@pytest.mark.parametrize(("front", "axes"), [("x", "x y z"), ("-x", "-x -y z"), ("y", "y -x z"), ("-y", "-y x z")])
def test_front_points_to_x(front: str, axes: str) -> None:
    found = align(model_of(truck_mesh()), front=front)
    assert " ".join(found.axes) == axes
    assert found.matrix[0, :3] @ np.eye(3)["xyz".index(front[-1])] == pytest.approx(-1 if "-" in front else 1)


def test_stray_part_does_not_lift_or_shift_the_model() -> None:
    mesh = trimesh.util.concatenate([truck_mesh(), boxes_mesh([((60, 0, -30), (60.1, 0.1, -29.9))])])
    found = align(model_of(mesh), up="z")
    np.testing.assert_allclose(found.matrix, CENTRED_TRUCK, atol=1e-6)
    assert any("far from the rest" in reason for reason in found.reasons)


def test_same_input_same_bytes() -> None:
    first, again = (align(model_of(truck_mesh())) for _ in range(2))
    assert first.matrix.tobytes() == again.matrix.tobytes()
    assert first.reasons == again.reasons


def test_tessellation_does_not_matter() -> None:
    fine = truck_mesh().subdivide().subdivide()
    coarse_matrix, fine_matrix = (align(model_of(mesh)).matrix for mesh in (truck_mesh(), fine))
    np.testing.assert_allclose(coarse_matrix, fine_matrix, atol=1e-6)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"up": "w"}, "up: 'w' is no direction; expected one of x, -x"),
        ({"front": "w"}, "front: 'w' is no direction"),
        ({"front": "-z", "up": "z"}, "front: '-z' is the up axis"),
        ({"method": "30rad"}, "align: '30rad' is unknown; expected one of npca"),
        ({"front": "0.1,0,3", "up": "z"}, "front: '0.1,0,3' is the up axis"),
        ({"method": "pca"}, "align: 'pca' is unknown; expected one of npca, edges, none, or an angle"),
        ({"fold": "wide"}, "fold: 'wide' is unknown"),
    ],
)
def test_unknown_options(options: dict[str, str], message: str) -> None:
    with pytest.raises(MeshError, match=message):
        align(model_of(truck_mesh()), **options)


@pytest.mark.parametrize(
    ("name", "axes", "symmetry"),
    [
        ("delivery_truck/delivery.obj", "z x y", 0.97),
        ("ambulance_missing_tex/ambulance.obj", "-y x z", 0.97),
        ("skull_100k/skull.obj", "z x y", 0.95),
        ("mayan_pyramid/q_mayan_temple.obj", "-x z y", 0.95),
    ],
)
def test_real_models(name: str, axes: str, symmetry: float, shared_meshes: Path) -> None:
    found = align(load_model(shared_meshes / name))
    assert " ".join(found.axes) == axes
    assert found.symmetry.score > symmetry
