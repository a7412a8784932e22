"""Shapes, atlas and polygons of which the models are made."""

import json
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh
from modelling.atlas import Atlas, around, everywhere, painted, plain
from modelling.mesh import FloatArray, normals
from modelling.polygon import ear_clipped
from modelling.shapes import arch, box, circle, cylinder, frustum, prism, rounds

TRUE_SIZE = 1e-9


def solid(triangles: FloatArray) -> trimesh.Trimesh:
    """The triangles as a mesh with shared corners."""
    return trimesh.Trimesh(**trimesh.triangles.to_kwargs(triangles), process=True)


@pytest.mark.parametrize("axis", "xyz")
def test_prism_of_a_concave_profile(axis: str) -> None:
    profile = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]
    mesh = solid(prism(profile, axis, -1, 3))
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(4 * 4, abs=TRUE_SIZE)  # L of area 4, 4 long


def test_orientation_of_the_profile_does_not_matter() -> None:
    profile = circle(1.0, 7)
    assert solid(prism(profile[::-1], "z", 0, 1)).volume == pytest.approx(solid(prism(profile, "z", 0, 1)).volume)


@pytest.mark.parametrize(
    ("triangles", "volume"),
    [
        (box((0, 0, 0), (1, 2, 3)), 6.0),
        (cylinder(2.0, "x", 0, 1, 24), 24 / 2 * 4 * np.sin(2 * np.pi / 24)),
        (frustum((1, 2), (0, 0), (0, 3), "y"), 8.0),  # pyramid: base 8, height 3
        (frustum((2, 1), (2, 0), (0, 3), "y"), 12.0),  # gable roof: half the box
        (rounds((0, 1), (1, 0), "z", 24), 24 / 2 * np.sin(2 * np.pi / 24) / 3),  # cone
    ],
)
def test_solids_are_closed_and_have_their_volume(triangles: FloatArray, volume: float) -> None:
    mesh = solid(triangles)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(volume, abs=TRUE_SIZE)


def test_arch_springs_from_its_base() -> None:
    points = np.array(arch((2.0, 0.5), 0.6, 0.7))
    assert points[[0, -1], 1] == pytest.approx(0.7)
    assert np.hypot(points[:, 0] - 2, points[:, 1] - 0.5) == pytest.approx(0.6)
    assert np.all(np.diff(points[:, 0]) > 0)


def test_ear_clipping_refuses_a_ring_without_area() -> None:
    with pytest.raises(ValueError, match="no area"):
        ear_clipped(np.array([(0, 0), (1, 1), (2, 2), (3, 3), (4, 4)], dtype=np.float64))


@pytest.mark.parametrize("facing", ["+x", "-x", "+z", "-z"])
def test_paint_lies_where_it_was_put(facing: str) -> None:
    """A spot painted at (0.5, 0.25) of the view is seen at that model point, on the side that faces it."""
    atlas = Atlas(64)
    view = atlas.view(facing, (-1, 1), (-1, 1), 20, "#ffffff")
    view.brush.disc((0.5, 0.25), 0.2, "#000000")
    mesh, picture = atlas.finished([painted(box((-1, -1, -1), (1, 1, 1)), everywhere(view))])
    pixels = np.asarray(picture)
    side = "xyz".index(facing[1])
    faces = normals(mesh.triangles)[:, side] * (1 if facing[0] == "+" else -1) > 0.5
    spot = np.zeros(3)
    spot[2 - side], spot[1], spot[side] = 0.5, 0.25, 1 if facing[0] == "+" else -1
    weights = trimesh.triangles.points_to_barycentric(mesh.triangles[faces], np.tile(spot, (2, 1)))
    inside = int(np.argmax(weights.min(axis=1)))
    u, v = weights[inside] @ mesh.uv[faces][inside]
    assert pixels[int((1 - v) * picture.height), int(u * picture.width)].tolist() == [0, 0, 0]


def test_views_around_are_mirrored_on_no_side() -> None:
    """On every side, texture grows to the viewer's right and upwards: triangles keep their turning sense."""
    atlas = Atlas(64)
    view = atlas.view("+z", (-1, 1), (-1, 1), 20, "#ffffff")
    skin = {**everywhere(atlas.swatch("#000000")), **around(view)}
    mesh, _ = atlas.finished([painted(box((-1, -1, -1), (1, 1, 1)), skin)])
    edges = mesh.uv[:, 1:] - mesh.uv[:, :1]
    upright = np.abs(normals(mesh.triangles)[:, 1]) < 0.5
    assert np.all(np.linalg.det(edges)[upright] > 0)
    assert np.linalg.det(edges)[~upright] == pytest.approx(0)


def test_atlas_tiles_do_not_overlap_and_too_wide_ones_are_refused() -> None:
    atlas = Atlas(64)
    tiles = [atlas.view("+z", (0, 1), (0, height), 10, "#ffffff") for height in (1, 3, 2, 4, 1, 1)]
    boxes = [v.pixels(np.array([(0, h, 0), (1, 0, 0)])) for v, h in zip(tiles, (1, 3, 2, 4, 1, 1), strict=True)]
    for i, a in enumerate(boxes):
        for b in boxes[:i]:
            assert np.any(np.minimum(a[1], b[1]) <= np.maximum(a[0], b[0]))
    with pytest.raises(ValueError, match="widen"):
        atlas.view("+z", (0, 10), (0, 1), 10, "#ffffff")


def test_mirroring_keeps_the_outside_outside() -> None:
    mesh = plain(box((1, 0, 0), (2, 1, 1)), Atlas(64).swatch("#000000"))
    assert solid(mesh.mirrored().triangles).volume == pytest.approx(1)
    assert mesh.mirrored().triangles[..., 0].max() == pytest.approx(-1)


def test_glb_is_laid_out_as_its_header_says(models: Path) -> None:
    data = (models / "hotel/hotel.glb").read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    (size,) = struct.unpack_from("<I", data, 12)
    header = json.loads(data[20 : 20 + size])
    start = 28 + size
    picture = header["bufferViews"][header["images"][0]["bufferView"]]
    first = start + picture["byteOffset"]
    assert data[first : first + 8] == b"\x89PNG\r\n\x1a\n"
    assert data[first + picture["byteLength"] - 8 :][:4] == b"IEND"
    assert all(view["byteOffset"] % 4 == 0 for view in header["bufferViews"])
    corners = header["bufferViews"][3]
    index = np.frombuffer(data, "<u2", corners["byteLength"] // 2, start + corners["byteOffset"])
    assert index.max() + 1 == header["accessors"][0]["count"] < 65535
