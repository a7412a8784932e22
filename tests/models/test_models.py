"""The committed models: they load, look as claimed, stay small, and come out of their script again."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

TEXTURED = {
    "truck/truck.obj",
    "monster_truck/monster_truck.glb",
    "town_hall/town_hall.obj",
    "hotel/hotel.glb",
    "tower/tower.ply",
}
BARE = {
    "t_shape/t_shape.stl": (5.0, 1e-6),  # volume, tolerance: five unit cubes
    "skewed_cube/skewed_cube.off": (1.0, 1e-9),  # shearing keeps the volume
    "half_sphere/half_sphere.stl": (2 * np.pi / 3, 0.02),  # of a polyhedron inscribed in it
}
SHIP = "ship/ship.obj"
ALL = sorted([*TEXTURED, *BARE, SHIP])
UP = {".obj": 1, ".glb": 1, ".ply": 2, ".stl": 2, ".off": 2}  # axis
MODEL_LIMIT, TOTAL_LIMIT = 300_000, 2_000_000  # bytes
SAME_PICTURE = 0.5  # mean difference in levels of 255: builds of FreeType smooth letters a little differently


@pytest.fixture(scope="module")
def remade(tmp_path_factory: pytest.TempPathFactory, models: Path) -> tuple[Path, Path]:
    """Two fresh runs of the script, with different hash seeds."""
    folders = (tmp_path_factory.mktemp("first"), tmp_path_factory.mktemp("second"))
    for seed, folder in enumerate(folders):
        command = [sys.executable, str(models / "make_models.py"), "--output", str(folder)]
        subprocess.run(command, check=True, env={**os.environ, "PYTHONHASHSEED": str(seed)})
    return folders


def files(folder: Path) -> list[str]:
    """Model files below `folder`, the code and caches left out."""
    found = (p.relative_to(folder) for p in folder.glob("[a-z]*/*") if p.is_file())
    return sorted(p.as_posix() for p in found if p.parts[0] != "modelling")


def same(one: Path, other: Path) -> bool:
    """Whether two files are equal byte by byte, or differ only in how their pictures were packed and smoothed."""
    if one.read_bytes() == other.read_bytes():
        return True
    if one.suffix == ".png":
        return same_picture(Image.open(one), Image.open(other))
    if one.suffix == ".glb":
        a, b = trimesh.load(one, force="mesh"), trimesh.load(other, force="mesh")
        shapes = np.array_equal(a.triangles, b.triangles) and np.array_equal(a.visual.uv, b.visual.uv)
        return shapes and same_picture(a.visual.material.baseColorTexture, b.visual.material.baseColorTexture)
    return False


def same_picture(one: Image.Image, other: Image.Image) -> bool:
    """Whether two pictures have one size and nearly the same pixels."""
    if one.size != other.size:
        return False
    difference = np.asarray(one.convert("RGB"), dtype=np.float64) - np.asarray(other.convert("RGB"))
    return bool(np.abs(difference).mean() < SAME_PICTURE)


def test_two_runs_write_the_same_bytes(remade: tuple[Path, Path]) -> None:
    first, second = remade
    assert files(first) == files(second)
    assert [n for n in files(first) if (first / n).read_bytes() != (second / n).read_bytes()] == []


def test_the_script_makes_the_committed_files(remade: tuple[Path, Path], models: Path) -> None:
    assert files(remade[0]) == files(models)
    assert [name for name in files(models) if not same(remade[0] / name, models / name)] == []


def test_comparison_sees_a_change(models: Path, tmp_path: Path) -> None:
    other = tmp_path / "half_sphere.stl"
    data = bytearray((models / "half_sphere/half_sphere.stl").read_bytes())
    data[100] ^= 1
    other.write_bytes(data)
    assert not same(models / "half_sphere/half_sphere.stl", other)
    picture = Image.open(models / "truck/truck.png")
    assert same_picture(picture, picture)
    assert not same_picture(picture, picture.transpose(Image.Transpose.FLIP_LEFT_RIGHT))
    assert not same(models / "hotel/hotel.glb", models / "monster_truck/monster_truck.glb")


@pytest.mark.parametrize("name", ALL)
def test_loads(models: Path, name: str) -> None:
    mesh = trimesh.load(models / name, force="mesh")
    assert len(mesh.faces) >= 12
    assert np.isfinite(mesh.vertices).all()
    assert mesh.extents.min() >= 0.1
    assert mesh.extents.max() <= 10
    lowest = mesh.bounds[0, UP[Path(name).suffix]]
    assert lowest == pytest.approx(0, abs=0.01)  # stands on the ground; wheels are polygons
    assert mesh.area_faces.min() > 0


@pytest.mark.parametrize("name", sorted(TEXTURED))
def test_texture_is_there_and_used(models: Path, name: str) -> None:
    visual = trimesh.load(models / name, force="mesh").visual
    picture = getattr(visual.material, "image", None) or visual.material.baseColorTexture
    assert min(picture.size) >= 400
    assert visual.uv.min() >= 0 and visual.uv.max() <= 1
    colours = visual.to_color().vertex_colors
    assert len(np.unique(colours, axis=0)) >= 8


def test_truck_is_red_where_its_cab_is(models: Path) -> None:
    """Texture coordinates count from the right side: the cab's roof is red, the roof of the box cream."""
    mesh = trimesh.load(models / "truck/truck.obj", force="mesh")
    picture = np.asarray(mesh.visual.material.image.convert("RGB"), dtype=np.float64)
    up = mesh.face_normals[:, 1] > 0.99
    height = mesh.triangles_center[:, 1]
    for level, colour in ((2.45, (216, 67, 47)), (3.0, (247, 240, 223))):
        faces = np.flatnonzero(up & (np.abs(height - level) < 1e-3))
        assert len(faces) == 2
        u, v = np.array([0.8, 0.1, 0.1]) @ mesh.visual.uv[mesh.faces[faces[0]]]  # near a corner
        seen = picture[int((1 - v) * picture.shape[0]), int(u * picture.shape[1])]
        assert np.abs(seen - colour).max() <= 2


def test_ship_has_colours_and_no_texture(models: Path) -> None:
    scene = trimesh.load(models / SHIP, force="scene")
    colours = {tuple(g.visual.material.main_color.tolist()) for g in scene.geometry.values()}
    assert len(colours) == 8
    assert all(g.visual.material.image is None for g in scene.geometry.values())


def test_hull_flares_upwards(models: Path) -> None:
    """The half width grows with height, and the bow is narrow at every level."""
    hull = trimesh.load(models / SHIP, force="scene").geometry["hull"].vertices
    low = hull[np.isclose(hull[:, 1], 0.4)]
    high = hull[np.isclose(hull[:, 1], 1.05)]
    assert high[:, 0].max() > low[:, 0].max() + 0.1
    for ring in (low, high):
        assert np.abs(ring[ring[:, 2] == ring[:, 2].max(), 0]).max() < 0.01


@pytest.mark.parametrize("name", sorted(set(ALL) - {"skewed_cube/skewed_cube.off"}))
def test_has_a_mirror_plane(models: Path, name: str) -> None:
    bounds = trimesh.load(models / name, force="mesh").bounds
    assert bounds[0, 0] == pytest.approx(-bounds[1, 0], abs=1e-6)


@pytest.mark.parametrize("name", sorted(BARE))
def test_bare_shapes_are_closed(models: Path, name: str) -> None:
    volume, tolerance = BARE[name]
    mesh = trimesh.load(models / name, force="mesh")
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(volume, abs=tolerance)


def test_models_are_small(models: Path) -> None:
    sizes: dict[str, int] = {}
    for name in files(models):
        model = name.split("/")[0]
        sizes[model] = sizes.get(model, 0) + (models / name).stat().st_size
    assert set(sizes) == {name.split("/")[0] for name in ALL}
    assert max(sizes.values()) < MODEL_LIMIT
    assert sum(sizes.values()) < TOTAL_LIMIT


def test_readme_lists_every_model(models: Path) -> None:
    text = (models / "README.md").read_text(encoding="utf-8")
    assert [name for name in ALL if f"`{name}`" not in text] == []
    assert "CC0" in text
