"""Compressed glTF is read where it can be, and refused by the name of its extension where not."""

import json
import logging
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from mesh_solids import truck_mesh
from trimesh.exchange.gltf import export_glb

from popsim.errors import MeshError
from popsim.mesh.gltf_extensions import LOOKS, READ, Unread, unread_extensions
from popsim.mesh.loading import load_model

DRACO_STEP = 2.0**-14
"""Draco keeps positions to this share of the longest side."""


def tree_of(data: bytes) -> tuple[dict[str, Any], bytes]:
    """The JSON of a GLB file, and the chunks that follow it."""
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[20 + length :]


def glb(tree: dict[str, Any], rest: bytes = b"") -> bytes:
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON")
    return head + text + rest


def requiring(*names: str) -> bytes:
    """A truck whose file says that it requires these extensions."""
    tree, rest = tree_of(export_glb(trimesh.Scene(truck_mesh())))
    return glb(tree | {"extensionsUsed": list(names), "extensionsRequired": list(names)}, rest)


def test_draco(tmp_path: Path) -> None:
    mesh = truck_mesh()
    data = export_glb(trimesh.Scene(mesh), extension_draco=True)
    assert tree_of(data)[0]["extensionsRequired"] == ["KHR_draco_mesh_compression"]
    (tmp_path / "truck.glb").write_bytes(data)
    model = load_model(tmp_path / "truck.glb")
    assert model.notes == ()
    assert len(model.surface.triangles) == len(mesh.faces)
    step = DRACO_STEP * mesh.extents.max()
    np.testing.assert_allclose(model.surface.bounds, mesh.bounds, atol=step)
    assert model.surface.areas.sum() == pytest.approx(mesh.area, rel=1e-3)


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (["EXT_meshopt_compression"], "extension EXT_meshopt_compression, which popsim does not read; export the"),
        (["KHR_future_shapes", "EXT_mesh_gpu_instancing"], "KHR_future_shapes and EXT_mesh_gpu_instancing"),
        (["KHR_mesh_quantization", "EXT_meshopt_compression"], "the glTF extension EXT_meshopt_compression"),
    ],
)
@pytest.mark.parametrize("suffix", [".glb", ".gltf"])
def test_an_unread_extension_is_named(names: list[str], words: str, suffix: str, tmp_path: Path) -> None:
    data = requiring(*names)
    path = tmp_path / f"truck{suffix}"
    path.write_bytes(data if suffix == ".glb" else json.dumps(tree_of(data)[0]).encode())
    with pytest.raises(MeshError) as caught:
        load_model(path)
    message = str(caught.value)
    assert words in message
    assert message.startswith(path.name)
    assert ("without compression" in message) == any("compression" in name for name in names)
    assert "\n" not in message


@pytest.mark.parametrize("name", ["KHR_mesh_quantization", "KHR_materials_unlit", "KHR_lights_punctual"])
def test_what_is_followed_or_may_be_passed_over_is_not_refused(name: str, tmp_path: Path) -> None:
    (tmp_path / "truck.glb").write_bytes(requiring(name))
    assert len(load_model(tmp_path / "truck.glb").surface.triangles) == len(truck_mesh().faces)
    assert name in READ or name.startswith(LOOKS)


@pytest.mark.parametrize("name", ["KHR_texture_transform", "KHR_texture_basisu"])
def test_what_changes_textures_only_is_noted(name: str, tmp_path: Path) -> None:
    (tmp_path / "truck.glb").write_bytes(requiring(name))
    model = load_model(tmp_path / "truck.glb")
    assert len(model.surface.triangles) == len(truck_mesh().faces)
    note = f"the glTF extension {name} is not read; textures may be missing or out of place"
    assert model.notes == (note,)


def test_coordinates_that_are_shares_of_a_range_are_refused(tmp_path: Path) -> None:
    tree, rest = tree_of(requiring("KHR_mesh_quantization"))
    tree["accessors"][tree["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]["normalized"] = True
    (tmp_path / "truck.glb").write_bytes(glb(tree, rest))
    with pytest.raises(MeshError, match="KHR_mesh_quantization, which popsim does not read"):
        load_model(tmp_path / "truck.glb")


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"glTF",
        b"glTF" + b"\0" * 40,
        glb({"asset": {}})[:24],
        b"[" * 100_000,
        b"[1]",
        b"\xff\xfe",
        b'{"extensionsRequired": "all"}',
        b'{"extensionsRequired": ["KHR_mesh_quantization"], "meshes": [1]}',
    ],
)
def test_damaged_files_are_left_to_the_reader(data: bytes) -> None:
    assert unread_extensions(data) == Unread([], [])


def test_what_trimesh_says_of_damaged_draco_is_not_logged(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    data = export_glb(trimesh.Scene(truck_mesh()), extension_draco=True)
    start = data.index(b"DRACO")
    (tmp_path / "truck.glb").write_bytes(data[:start] + b"\0" * 40 + data[start + 40 :])
    with caplog.at_level(logging.DEBUG), pytest.raises(MeshError):
        load_model(tmp_path / "truck.glb")
    assert not caplog.records
    assert capfd.readouterr() == ("", "")
    assert logging.getLogger("trimesh").propagate
    assert not logging.getLogger("trimesh").handlers
