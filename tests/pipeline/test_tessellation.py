"""A design depends on the shape, not on how its surface is cut into triangles, nor on how it lies in its file."""

from pathlib import Path

import numpy as np
import trimesh

from popsim.fitting import FitSettings
from popsim.mechanisms import Mechanism
from popsim.pipeline.abstract import abstract
from popsim.pipeline.prepare import Stance, prepare

SAME = 0.01
"""mm; designs that differ by less are cut from paper as one."""


def chosen(path: Path, up: str = "z") -> tuple[Mechanism, ...]:
    return abstract(prepare(path, Stance(up=up), 150.0, 0), FitSettings(), 0).mechanisms


def assert_same(found: tuple[Mechanism, ...], expected: tuple[Mechanism, ...]) -> None:
    assert [(m.type, m.pair.patches) for m in found] == [(m.type, m.pair.patches) for m in expected]
    for mechanism, other in zip(found, expected, strict=True):
        for plate, twin in zip(mechanism.plates(), other.plates(), strict=True):
            np.testing.assert_allclose(plate.outline, twin.outline, atol=SAME)


def fine(mesh: trimesh.Trimesh, least: int) -> trimesh.Trimesh:
    """The same surface in at least as many triangles, of many sizes."""
    rng = np.random.default_rng(0)
    vertices, faces = mesh.vertices, mesh.faces
    while len(faces) < least:
        some = np.flatnonzero(rng.random(len(faces)) < 0.7)
        vertices, faces = trimesh.remesh.subdivide(vertices, faces, face_index=some)
    return trimesh.Trimesh(vertices, faces, process=False)


def truck() -> trimesh.Trimesh:
    parts = [((-30, -10, 5), (10, 10, 30)), ((10, -10, 5), (25, 10, 15)), ((-25, -11, 0), (-17, 11, 8))]
    return trimesh.util.concatenate([trimesh.creation.box(bounds=np.array(box, float)) for box in parts])


def test_a_box_of_12_triangles_and_of_100000(tmp_path: Path) -> None:
    box = trimesh.creation.box([90, 60, 40])
    box.export(tmp_path / "coarse.ply")
    many = fine(box, 100_000)
    many.export(tmp_path / "fine.ply")
    assert (len(box.faces), len(many.faces) >= 100_000) == (12, True)
    assert_same(chosen(tmp_path / "fine.ply"), chosen(tmp_path / "coarse.ply"))


def test_a_truck_cut_up_and_lying_askew(tmp_path: Path) -> None:
    truck().export(tmp_path / "upright.ply")
    turn = trimesh.transformations.rotation_matrix(2.0, [0.3, -0.7, 0.4], [5, 6, 7])
    fine(truck(), 20_000).apply_transform(turn).export(tmp_path / "askew.ply")
    up = ",".join(repr(float(part)) for part in turn[:3, 2])
    assert_same(chosen(tmp_path / "askew.ply", up), chosen(tmp_path / "upright.ply"))
