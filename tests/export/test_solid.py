"""The pop-up in space, read back by other means."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from printed_design import Printed
from scipy.spatial.transform import Rotation, Slerp

from popsim.errors import InputError, OutputError
from popsim.export.solid import SOLIDS, export_solid
from popsim.simulation import fold_design

ROOT = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]) / 1000
"""Card frame, mm, to glTF: y up, m."""


@pytest.fixture(scope="module")
def glb(printed: Printed, tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], bytes]:
    """The JSON of an animated GLB, and its buffer."""
    path = tmp_path_factory.mktemp("glb") / "s.glb"
    export_solid(printed.design, path, "glb", textures=printed.folder)
    content = path.read_bytes()
    magic, version, length = struct.unpack("<4sII", content[:12])
    assert (magic, version, length) == (b"glTF", 2, len(content))
    size, kind = struct.unpack("<I4s", content[12:20])
    assert kind == b"JSON"
    assert content[24 + size : 28 + size] == b"BIN\0"
    return json.loads(content[20 : 20 + size]), content[28 + size :]


def values(glb: tuple[dict[str, Any], bytes], number: int) -> np.ndarray:
    """The numbers of an accessor."""
    data, buffer = glb
    accessor = data["accessors"][number]
    view = data["bufferViews"][accessor["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
    return np.frombuffer(buffer, kind, accessor["count"] * width, view["byteOffset"]).reshape(-1, width)


def test_the_animation_moves_each_patch_as_simulated(glb: tuple[dict[str, Any], bytes], printed: Printed) -> None:
    data, _ = glb
    root = data["nodes"][data["scenes"][0]["nodes"][0]]
    angles = np.array(root["extras"]["fold_angles"])
    sweep = fold_design(printed.design, (len(angles) - 1) // 2).sweep
    assert angles == pytest.approx(sweep.degrees)
    tracks: dict[tuple[int, str], np.ndarray] = {}
    for channel in data["animations"][0]["channels"]:
        sampler = data["animations"][0]["samplers"][channel["sampler"]]
        tracks[channel["target"]["node"], channel["target"]["path"]] = values(glb, sampler["output"])
    middle = len(angles) // 4
    for number in root["children"]:
        node = data["nodes"][number]
        corners = values(glb, data["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"])
        patch = sweep.index[node["name"]]
        places, turns = tracks[number, "translation"], tracks[number, "rotation"]
        opened = corners + np.array(node["translation"])
        for frame in (0, middle, sweep.closed):
            shown = Rotation.from_quat(turns[frame]).apply(corners) + places[frame]
            pose = sweep.poses[frame, patch]
            assert shown == pytest.approx(opened @ pose[:3, :3].T + pose[:3, 3], abs=2e-3)
        # between two keys a viewer interpolates: no corner strays visibly from its hinge
        half = Slerp([0, 1], Rotation.from_quat(turns[middle : middle + 2]))(0.5)
        between = half.apply(corners) + places[middle : middle + 2].mean(axis=0)
        ends = [Rotation.from_quat(turns[k]).apply(corners) + places[k] for k in (middle, middle + 1)]
        assert np.abs(between - (ends[0] + ends[1]) / 2).max() < 0.1


def test_every_patch_is_there_with_its_picture(glb: tuple[dict[str, Any], bytes], printed: Printed) -> None:
    data, _ = glb
    names = {node["name"] for node in data["nodes"]} - {"card"}
    assert names == {patch.id for patch in printed.design.patches}
    textured = sum(patch.texture is not None for patch in printed.design.patches)
    assert len(data["images"]) == textured


def test_solids_are_read_by_others(printed: Printed, tmp_path: Path) -> None:
    points = np.concatenate([patch.points for patch in printed.design.patches])
    bounds = np.array([points.min(axis=0), points.max(axis=0)])
    flipped = np.sort(bounds @ ROOT.T, axis=0)
    for name, expected in (("glb", flipped), ("obj", bounds), ("stl", bounds)):
        export_solid(printed.design, tmp_path / f"s.{name}", name, textures=printed.folder, angle=180)
        loaded = trimesh.load(tmp_path / f"s.{name}")
        assert loaded.bounds == pytest.approx(expected, abs=1e-3)
    area = sum(patch.plane.polygon(patch.points, patch.hole_points).area for patch in printed.design.patches)
    assert trimesh.load(tmp_path / "s.stl").area == pytest.approx(area, rel=1e-4)


def test_the_picture_of_an_obj_lies_the_right_way_round(printed: Printed, tmp_path: Path) -> None:
    """The red upper left corner of the picture is where the texture frame says."""
    export_solid(printed.design, tmp_path / "s.obj", "obj", textures=printed.folder)
    loaded = trimesh.load(tmp_path / "s.obj", split_object=True, group_material=False)
    checked = 0
    for mesh in loaded.geometry.values():
        image = getattr(mesh.visual.material, "image", None)
        if image is None:
            continue
        spots, colours = mesh.visual.uv, np.asarray(image.convert("RGB"))
        height, width = colours.shape[:2]
        upper_left = int((spots @ [-1.0, 1.0]).argmax())
        if np.abs(spots[upper_left] - [0, 1]).max() < 0.02:
            row, column = int((1 - spots[upper_left, 1]) * (height - 1)), int(spots[upper_left, 0] * (width - 1))
            assert tuple(colours[row, column]) == (255, 0, 0)
            checked += 1
    assert checked > 5


@pytest.mark.parametrize("angle", [0.0, 37.5, 90.0])
def test_any_fold_angle_is_met(printed: Printed, tmp_path: Path, angle: float) -> None:
    """The far edges of the two pages are as far apart as the fold angle says."""
    export_solid(printed.design, tmp_path / "s.stl", "stl", textures=printed.folder, angle=angle)
    bounds = trimesh.load(tmp_path / "s.stl").bounds
    depth = printed.design.card.depth
    half = np.radians(angle / 2)
    assert bounds[0, 1] == pytest.approx(-depth * np.sin(half), abs=0.01)
    assert bounds[1, 2] == pytest.approx(depth * np.cos(half), abs=0.01)


@pytest.mark.parametrize("name", sorted(SOLIDS))
def test_same_design_same_bytes(name: str, printed: Printed, tmp_path: Path) -> None:
    made = []
    for folder in ("one", "other"):
        (tmp_path / folder).mkdir()
        files = export_solid(
            printed.design, tmp_path / folder / f"s.{name}", name, textures=printed.folder, angle=90
        )
        made.append([file.read_bytes() for file in files])
    assert made[0] == made[1]
    with pytest.raises(OutputError, match="exists"):
        export_solid(printed.design, tmp_path / "one" / f"s.{name}", name, textures=printed.folder, angle=90)


def test_what_makes_no_sense_is_refused(printed: Printed, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="glb, obj, stl"):
        export_solid(printed.design, tmp_path / "s.ply", "ply", textures=printed.folder)
    with pytest.raises(InputError, match="180"):
        export_solid(printed.design, tmp_path / "s.stl", "stl", textures=printed.folder, angle=200)
