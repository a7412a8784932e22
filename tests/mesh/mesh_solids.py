"""Small solids for the tests of the mesh door."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import trimesh

from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Material, Surface
from popsim.mesh.model import Model

Box = tuple[Sequence[float], Sequence[float]]

TRUCK: tuple[Box, ...] = (
    # lowest and highest corner; the front, at +x, is lower than the load at -x; mirror plane y = 0, up z
    ((-3.0, -1.0, 0.5), (1.0, 1.0, 3.0)),
    ((1.0, -1.0, 0.5), (2.5, 1.0, 1.5)),
    ((-2.5, -1.1, 0.0), (-1.7, -0.7, 0.8)),
    ((-2.5, 0.7, 0.0), (-1.7, 1.1, 0.8)),
    ((1.2, -1.1, 0.0), (2.0, -0.7, 0.8)),
    ((1.2, 0.7, 0.0), (2.0, 1.1, 0.8)),
)


def surface_of(mesh: trimesh.Trimesh) -> Surface:
    """A white surface of the triangles of a mesh."""
    count = len(mesh.faces)
    return Surface(mesh.triangles, np.zeros((count, 3, 2)), np.zeros(count, dtype=int), (Material(np.ones(4)),))


def boxes_mesh(boxes: Sequence[Box]) -> trimesh.Trimesh:
    """A mesh of boxes, given by their lowest and highest corners."""
    return trimesh.util.concatenate([trimesh.creation.box(bounds=np.array(box)) for box in boxes])


def truck_mesh() -> trimesh.Trimesh:
    """A truck, upright (z), its lower front to +x, the mirror plane at y = 0."""
    return boxes_mesh(TRUCK)


def model_of(mesh: trimesh.Trimesh, matrix: FloatArray | None = None, suffix: str = ".stl") -> Model:
    """A model of a mesh, moved by a matrix, as if it had been read from a file of that suffix."""
    surface = surface_of(mesh)
    if matrix is not None:
        surface = surface.transformed(matrix)
    return Model(Path("made" + suffix), "0" * 64, surface, suffix[1:].upper())


def turn(axis: FloatArray, degrees: float) -> FloatArray:
    """Homogeneous rotation about an axis through the origin."""
    return np.asarray(trimesh.transformations.rotation_matrix(np.radians(degrees), axis))


def shift(*offset: float) -> FloatArray:
    """Homogeneous translation."""
    return np.asarray(trimesh.transformations.translation_matrix(offset))
