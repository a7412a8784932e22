"""Every format comes through the door unchanged; what is unusable is left out with a note."""

import dataclasses
import hashlib
import logging
import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh
from mesh_solids import truck_mesh

from popsim.mesh.formats import FORMATS
from popsim.mesh.loading import load_model

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


def sorted_corners(triangles: np.ndarray) -> np.ndarray:
    flat = np.round(triangles, 5).reshape(len(triangles), 9)
    return flat[np.lexsort(flat.T)]


def turned_scene() -> trimesh.Scene:
    """Two instances of one geometry, one of them mirrored, so that node transforms matter."""
    scene = trimesh.Scene()
    box = trimesh.creation.box([1, 2, 3])
    place = trimesh.transformations.rotation_matrix(0.3, [1, 2, 3], [1, 0, 0])
    scene.add_geometry(box, geom_name="box", node_name="a", transform=place)
    scene.graph.update("b", geometry="box", matrix=np.diag([-1.0, 1.0, 1.0, 1.0]) @ place)
    return scene


@pytest.mark.parametrize("suffix", FORMATS)
def test_round_trip(suffix: str, tmp_path: Path) -> None:
    mesh = truck_mesh()
    path = tmp_path / f"truck{suffix}"
    if suffix == ".gltf":
        for name, data in trimesh.exchange.gltf.export_gltf(trimesh.Scene(mesh)).items():
            (tmp_path / name.replace("model.gltf", path.name)).write_bytes(data)
    else:
        mesh.export(path)
    model = load_model(path)
    np.testing.assert_allclose(sorted_corners(model.surface.triangles), sorted_corners(mesh.triangles), atol=2e-5)
    assert model.format == FORMATS[suffix].name
    assert model.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
    assert model.notes == ()


@pytest.mark.parametrize("suffix", [".glb", ".3mf", ".obj"])
def test_coordinates_are_those_of_the_scene(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"scene{suffix}"
    turned_scene().export(path)
    reference = trimesh.load(path, force="mesh", process=False)
    np.testing.assert_array_equal(load_model(path).surface.triangles, reference.vertices[reference.faces])


def test_real_models_have_the_coordinates_of_trimesh(shared_meshes: Path) -> None:
    for name in ("milk_truck/CesiumMilkTruck.glb", "cube_gears/cube_gears.3mf", "suv_hummer/suv.obj"):
        reference = trimesh.load(shared_meshes / name, force="mesh", process=False)
        corners = reference.vertices[reference.faces]
        kept = load_model(shared_meshes / name).surface.triangles
        rows = {row.tobytes() for row in corners}
        assert all(row.tobytes() in rows for row in kept)
        assert len(kept) > 0.99 * len(corners)


def test_suffix_in_capitals(tmp_path: Path) -> None:
    path = tmp_path / "TRUCK.STL"
    path.write_bytes(truck_mesh().export(file_type="stl"))
    assert len(load_model(path).surface.triangles) == len(truck_mesh().faces)


def test_undefined_and_degenerate_faces_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "bad.obj"
    path.write_text(TETRAHEDRON + "v nan 0 0\nv 2 0 0\nf 1 2 5\nf 1 2 6\nf 1 1 2\n")
    model = load_model(path)
    assert len(model.surface.triangles) == 4
    assert np.isfinite(model.surface.triangles).all()
    assert model.notes == (
        "faces left out because their coordinates are not numbers: 1",
        "faces left out because they have no area: 2",
    )


def test_small_but_sound_faces_stay(tmp_path: Path) -> None:
    path = tmp_path / "small.obj"
    path.write_text(TETRAHEDRON + "v 0 0 2\nv 1e-6 0 2\nv 0 1e-6 2\nf 5 6 7\n")
    model = load_model(path)
    assert len(model.surface.triangles) == 5
    assert model.notes == ()


def test_model_is_frozen_and_locked(tmp_path: Path) -> None:
    path = tmp_path / "t.obj"
    path.write_text(TETRAHEDRON)
    model = load_model(path)
    with pytest.raises(dataclasses.FrozenInstanceError):
        model.format = "STL"  # type: ignore[misc]  # the point of the test
    with pytest.raises(ValueError, match="read-only"):
        model.surface.triangles[0, 0, 0] = 1.0


def test_nothing_is_logged_or_warned(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = tmp_path / "t.obj"
    path.write_text("mtllib none.mtl\n" + TETRAHEDRON)
    with caplog.at_level(logging.DEBUG), warnings.catch_warnings():
        warnings.simplefilter("error")
        model = load_model(path)
    assert not [r for r in caplog.records if r.name.startswith("trimesh")]
    assert len(model.notes) == 1
    assert "none.mtl" in model.notes[0]
