"""Textures, material colours and vertex or face colours survive the door."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from trimesh.visual.material import PBRMaterial

from popsim.mesh.loading import load_model
from popsim.mesh.materials import srgb

QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
FACES = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"
RED_TOP = np.array([[[255, 0, 0], [255, 0, 0]], [[0, 0, 255], [0, 255, 0]]], dtype=np.uint8)


def write_obj(folder: Path, mtl: str, picture: str | None = "paint.png") -> Path:
    if picture:
        (folder / picture).parent.mkdir(exist_ok=True)
        Image.fromarray(RED_TOP).save(folder / picture)
    (folder / "quad.mtl").write_text(f"newmtl m\n{mtl}\n")
    path = folder / "quad.obj"
    path.write_text("mtllib quad.mtl\n" + QUAD + "usemtl m\n" + FACES)
    return path


def test_texture_and_its_orientation(tmp_path: Path) -> None:
    surface = load_model(write_obj(tmp_path, "map_Kd paint.png")).surface
    material = surface.materials[surface.material[0]]
    np.testing.assert_array_equal(material.texture[..., :3], RED_TOP)
    np.testing.assert_array_equal(material.colour, np.ones(4))
    # v = 1 is row 0: the corners with y = 1 are red
    np.testing.assert_allclose(surface.uv[..., 1], surface.triangles[..., 1])
    np.testing.assert_allclose(surface.uv[..., 0], surface.triangles[..., 0])


@pytest.mark.parametrize(
    "statement",
    ["textures\\paint.png", "TEXTURES/PAINT.PNG", "C:\\work\\art\\paint.png", "-s 1 1 1 -clamp on paint.png"],
)
def test_names_as_authors_write_them(statement: str, tmp_path: Path) -> None:
    write_obj(tmp_path, "", "textures/paint.png")
    model = load_model(write_obj(tmp_path, f"map_Kd {statement}"))
    assert model.surface.textured
    assert model.notes == ()


@pytest.mark.parametrize(("kd", "expected"), [("0.5 0.5 0.5", [1, 1, 1]), ("1 0.5 0", [1, 0.5, 0])])
def test_a_grey_kd_does_not_dim_a_texture(kd: str, expected: list[float], tmp_path: Path) -> None:
    surface = load_model(write_obj(tmp_path, f"Kd {kd}\nmap_Kd paint.png")).surface
    np.testing.assert_allclose(surface.materials[0].colour[:3], expected, atol=1 / 255)


def test_material_colour_and_dissolve(tmp_path: Path) -> None:
    surface = load_model(write_obj(tmp_path, "Kd 0.2 0.4 0.6\nd 0.5", None)).surface
    np.testing.assert_allclose(surface.materials[0].colour, [0.2, 0.4, 0.6, 0.5], atol=1 / 255)
    assert not surface.textured


def test_missing_texture_is_noted_and_the_colour_used(tmp_path: Path) -> None:
    model = load_model(write_obj(tmp_path, "Kd 0.2 0.4 0.6\nmap_Kd gone.png", None))
    assert len(model.notes) == 1
    assert "gone.png" in model.notes[0]
    np.testing.assert_allclose(model.surface.materials[0].colour[:3], [0.2, 0.4, 0.6], atol=1 / 255)


def test_damaged_texture_is_noted(tmp_path: Path) -> None:
    (tmp_path / "paint.png").write_bytes(b"no picture")
    model = load_model(write_obj(tmp_path, "Kd 0.2 0.4 0.6\nmap_Kd paint.png", None))
    assert "not an image" in model.notes[0]
    assert not model.surface.textured


def test_truncated_texture_is_noted(tmp_path: Path) -> None:
    path = write_obj(tmp_path, "map_Kd paint.png")
    noise = np.random.default_rng(0).integers(0, 255, (64, 64, 3), dtype=np.uint8)
    Image.fromarray(noise).save(tmp_path / "paint.png")
    data = (tmp_path / "paint.png").read_bytes()
    (tmp_path / "paint.png").write_bytes(data[: len(data) // 2])
    model = load_model(path)
    assert "cannot be decoded" in model.notes[0]
    assert not model.surface.textured


def test_missing_texture_of_a_real_model(shared_meshes: Path) -> None:
    model = load_model(shared_meshes / "ambulance_missing_tex" / "ambulance.obj")
    assert any("wheels_01.png" in note for note in model.notes)
    assert [m.texture is not None for m in model.surface.materials].count(True) == 1


def test_two_materials_keep_their_faces(tmp_path: Path) -> None:
    (tmp_path / "two.mtl").write_text("newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n")
    text = "mtllib two.mtl\n" + QUAD + "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n"
    (tmp_path / "two.obj").write_text(text)
    surface = load_model(tmp_path / "two.obj").surface
    for triangle, index in zip(surface.triangles, surface.material, strict=True):
        is_first = triangle[:, 0].mean() > 0.5
        np.testing.assert_allclose(surface.materials[index].colour[:3], [1, 0, 0] if is_first else [0, 0, 1])


def glb(path: Path, material: PBRMaterial, generator: str | None = None) -> Path:
    """A textured quad; `generator` replaces the name of the program that wrote it."""
    mesh = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], process=False)
    mesh.visual = trimesh.visual.TextureVisuals(uv=[[0, 0], [1, 0], [1, 1], [0, 1]], material=material)
    data = mesh.export(file_type="glb")
    if generator:
        known = b"https://github.com/mikedh/trimesh"
        assert known in data
        data = data.replace(known, generator.encode().ljust(len(known)))
    path.write_bytes(data)
    return path


def test_glb_texture_and_factor(tmp_path: Path) -> None:
    material = PBRMaterial(baseColorTexture=Image.fromarray(RED_TOP), baseColorFactor=[255, 128, 0, 255])
    surface = load_model(glb(tmp_path / "q.glb", material)).surface
    found = surface.materials[surface.material[0]]
    np.testing.assert_array_equal(found.texture[..., :3], RED_TOP)
    np.testing.assert_allclose(found.colour, [1, 128 / 255, 0, 1], atol=1 / 255)
    np.testing.assert_allclose(surface.uv[..., 1], surface.triangles[..., 1], atol=1e-6)


@pytest.mark.parametrize(("mode", "stated", "alpha"), [("OPAQUE", 51, 1.0), ("BLEND", 51, 0.2), ("BLEND", 0, 1.0)])
def test_alpha_counts_only_where_the_material_blends(mode: str, stated: int, alpha: float, tmp_path: Path) -> None:
    material = PBRMaterial(baseColorFactor=[255, 0, 0, stated], alphaMode=mode)
    surface = load_model(glb(tmp_path / "q.glb", material)).surface
    assert surface.materials[0].colour[3] == pytest.approx(alpha)


def test_linear_factors_become_display_values(tmp_path: Path) -> None:
    material = PBRMaterial(baseColorFactor=[255, 128, 0, 255])
    surface = load_model(glb(tmp_path / "q.glb", material, "another writer")).surface
    # IEC 61966-2-1: linear 0.502 is shown as 0.737
    np.testing.assert_allclose(surface.materials[0].colour, [1, 0.737, 0, 1], atol=3e-3)


def test_srgb_known_values() -> None:
    np.testing.assert_allclose(
        srgb(np.array([0.0, 0.0031308, 0.2140, 1.0])), [0, 0.04045, 0.5, 0.0 + 1.0], atol=2e-4
    )


def test_instances_share_one_material(tmp_path: Path) -> None:
    path = glb(tmp_path / "q.glb", PBRMaterial(baseColorTexture=Image.fromarray(RED_TOP)))
    scene = trimesh.load_scene(path)
    name = next(iter(scene.geometry))
    scene.graph.update("again", geometry=name, matrix=trimesh.transformations.translation_matrix([3, 0, 0]))
    scene.export(tmp_path / "two.glb")
    surface = load_model(tmp_path / "two.glb").surface
    assert len(surface.triangles) == 4
    assert len(surface.materials) == 1


@pytest.mark.parametrize("kind", ["vertex", "face"])
def test_colours_of_a_ply(kind: str, tmp_path: Path) -> None:
    mesh = trimesh.creation.box([1, 1, 1])
    if kind == "vertex":
        mesh.visual.vertex_colors = np.c_[(mesh.vertices + 0.5) * 255, np.full(8, 255)].astype(np.uint8)
    else:
        mesh.visual.face_colors = np.array([[20 * k, 0, 0, 255] for k in range(12)], dtype=np.uint8)
    mesh.export(tmp_path / "c.ply")
    surface = load_model(tmp_path / "c.ply").surface
    if kind == "vertex":
        np.testing.assert_allclose(surface.colours[..., :3], surface.triangles + 0.5, atol=1 / 255)
    else:
        np.testing.assert_allclose(surface.colours[:, 0, 0], np.arange(12) * 20 / 255, atol=1e-9)
        assert (np.ptp(surface.colours, axis=1) == 0).all()


def test_a_model_without_colours_is_white(tmp_path: Path) -> None:
    trimesh.creation.box([1, 1, 1]).export(tmp_path / "c.stl")
    surface = load_model(tmp_path / "c.stl").surface
    assert surface.colours is None
    np.testing.assert_array_equal(surface.materials[0].colour, np.ones(4))


@pytest.mark.parametrize("head", ["", "usemtl m\n", "mtllib gone.mtl\nusemtl m\n"])
def test_texture_coordinates_without_a_material_print_nothing(head: str, tmp_path: Path) -> None:
    path = tmp_path / "bare.obj"
    path.write_text(head + QUAD + FACES)
    surface = load_model(path).surface
    assert not surface.textured
    assert surface.colours is None
    np.testing.assert_array_equal(surface.materials[0].colour, np.ones(4))


def test_faces_without_a_material_are_white_beside_coloured_ones(tmp_path: Path) -> None:
    (tmp_path / "half.mtl").write_text("newmtl a\nKd 1 0 0\n")
    text = "mtllib half.mtl\n" + QUAD + "f 1/1 2/2 3/3\nusemtl a\nf 1/1 3/3 4/4\n"
    (tmp_path / "half.obj").write_text(text)
    surface = load_model(tmp_path / "half.obj").surface
    assert not surface.textured
    colours = [surface.materials[index].colour for index in surface.material]
    np.testing.assert_allclose(sorted(colour[1] for colour in colours), [0, 1])


def test_a_texture_of_the_same_grey_stays_a_texture(tmp_path: Path) -> None:
    path = write_obj(tmp_path, "map_Kd paint.png")
    Image.new("RGBA", (2, 2), (100, 100, 100, 255)).save(tmp_path / "paint.png")
    assert load_model(path).surface.textured


def test_missing_buffer_is_an_error_but_missing_picture_a_note(tmp_path: Path) -> None:
    material = PBRMaterial(baseColorFactor=[255, 0, 0, 255])
    mesh = trimesh.load_scene(glb(tmp_path / "q.glb", material))
    files = trimesh.exchange.gltf.export_gltf(mesh)
    tree = json.loads(files.pop("model.gltf"))
    tree["images"] = [{"uri": "gone%20for%20good.png"}]
    tree["textures"] = [{"source": 0}]
    tree["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    (tmp_path / "q.gltf").write_text(json.dumps(tree))
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
    model = load_model(tmp_path / "q.gltf")
    assert len(model.notes) == 1
    assert "gone%20for%20good.png" in model.notes[0]
    np.testing.assert_allclose(model.surface.materials[0].colour, [1, 0, 0, 1])


@pytest.mark.parametrize(("line", "alpha"), [("", 255), ("map_d skin.png\n", 0)])
def test_alpha_of_an_mtl_texture_counts_only_where_map_d_names_it(line: str, alpha: int, tmp_path: Path) -> None:
    Image.new("RGBA", (4, 4), (200, 10, 10, 0)).save(tmp_path / "skin.png")
    (tmp_path / "a.mtl").write_text(f"newmtl m\nKd 1 1 1\nmap_Kd skin.png\n{line}")
    (tmp_path / "a.obj").write_text(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
        "f 1/1 2/2 3/3\nf 1/1 2/2 4/3\n"
    )
    texture = load_model(tmp_path / "a.obj").surface.materials[0].texture
    assert texture is not None and (texture[..., 3] == alpha).all()
