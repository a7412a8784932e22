"""FOLD 1.2: crease patterns of the pieces and the folding of the pop-up, for the tools of the origami community.

One file is the whole design. Its own frame holds the crease patterns of all pieces as they lie on the sheets,
sheets side by side, with `faces_vertices`. The first of the other frames is the open pose: one face per part
(triangles where it has holes), with `popsim:` keys for what each face is and what is glued where. Frames that
inherit from it are the card at smaller fold angles. Beside it each piece has a file of its own with its crease
pattern, for tools that load single sheets.
"""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from popsim.export.job import Job
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move
from popsim.layout import Crease, Layout, Piece, Placement
from popsim.simulation import Sweep

if TYPE_CHECKING:
    from shapely.geometry import Polygon

SAME = 0.01
"""mm; corners this close are one vertex, and lines this close meet."""

DECIMALS = 6

BETWEEN_SHEETS = 10.0
"""mm between two sheets."""

STEP = 15.0
"""Degrees between the frames of the folding."""

OPEN_FRAME = 1
"""Number of the frame of the open pose; the file's own is 0."""

ASSIGNMENT = {Crease.MOUNTAIN: "M", Crease.VALLEY: "V", Crease.NONE: "F"}


def write_fold(job: Job, path: Path) -> tuple[Path, ...]:
    """Write one FOLD file of the whole design and one per piece; the same layout gives the same bytes."""
    whole = _pattern(job.title, "pieces as cut", job.layout, job.layout.placements)
    files = {path: whole | {"file_classes": ["singleModel"], "file_frames": list(_folding(job.layout, job.sweep))}}
    for placement in job.layout.placements:
        name = placement.piece.name
        own = path.with_name(f"{path.stem}-{name.replace('/', '-')}{path.suffix}")
        files[own] = _pattern(f"{job.title}, {name}", name, job.layout, (placement,))
    for file, content in files.items():
        file.write_text(json.dumps(content, allow_nan=False, separators=(",", ":")) + "\n", encoding="utf-8")
    return tuple(files)


def _pattern(title: str, frame: str, layout: Layout, placements: tuple[Placement, ...]) -> dict[str, Any]:
    """A file whose frame is the crease pattern of some pieces."""
    return {
        "file_spec": 1.2,
        "file_creator": "popsim",
        "file_title": title,
        "file_classes": ["singleModel"],
        "frame_unit": "mm",
        "frame_title": frame,
        "frame_classes": ["creasePattern"],
        "frame_attributes": ["2D"],
        **_crease_pattern(layout, placements),
    }


class _Mesh:
    """Vertices, each once per group, with the edges and faces between them."""

    def __init__(self) -> None:
        self.vertices: list[list[float]] = []
        self.groups: list[str] = []
        self.faces: list[list[int]] = []
        self.edges: dict[tuple[int, int], str] = {}
        self._index: dict[tuple[Any, ...], int] = {}

    def add(self, ring: FloatArray, group: str, assignments: list[str]) -> None:
        """Add a face (n, d) and its edges; vertices are shared within `group`."""
        corners = [self._vertex(point, group) for point in ring]
        self.faces.append(corners)
        for a, b, assignment in zip(corners, corners[1:] + corners[:1], assignments, strict=True):
            self.edges.setdefault((min(a, b), max(a, b)), assignment)

    def data(self) -> dict[str, Any]:
        return {
            "vertices_coords": self.vertices,
            "edges_vertices": [list(key) for key in self.edges],
            "edges_assignment": list(self.edges.values()),
            "faces_vertices": self.faces,
        }

    def _vertex(self, point: FloatArray, group: str) -> int:
        key = (group, *(int(v) for v in np.round(point / SAME)))
        if key not in self._index:
            self._index[key] = len(self.vertices)
            self.vertices.append([float(v) for v in np.round(point, DECIMALS) + 0.0])
            self.groups.append(group)
        return self._index[key]


def _crease_pattern(layout: Layout, placements: tuple[Placement, ...]) -> dict[str, Any]:
    mesh = _Mesh()
    owners = []
    for placement in placements:
        shift = np.array([placement.sheet * (layout.paper.width + BETWEEN_SHEETS), 0.0])
        for ring, assignments in _piece_faces(placement.piece):
            mesh.add(move(placement.motion, ring) + shift, placement.piece.name, assignments)
            owners.append(placement.piece.name)
    return {**mesh.data(), "faces_popsim:piece": owners}


def _piece_faces(piece: Piece) -> list[tuple[FloatArray, list[str]]]:
    """What outline, slits and creases of a piece enclose: rings with the assignment of each edge."""
    import shapely

    creases = [(shapely.LineString(fold.ends), ASSIGNMENT[fold.crease]) for fold in piece.folds]
    cuts = [shapely.LineString(ring) for ring in (piece.outline.exterior, *piece.outline.interiors)]
    cuts += [shapely.LineString(slit) for slit in piece.slits]
    noded = shapely.unary_union([*cuts, *(line for line, _ in creases)], grid_size=SAME)
    border = shapely.unary_union(cuts)
    faces = []
    for face in shapely.get_parts(shapely.polygonize(shapely.get_parts(noded))):
        if not piece.outline.contains(face.representative_point()):
            continue  # a hole of the outline
        for ring in _without_holes(face):
            middles = shapely.points((ring + np.roll(ring, -1, axis=0)) / 2)
            faces.append((ring, [_assignment(middle, border, creases) for middle in middles]))
    return faces


def _without_holes(face: "Polygon") -> list[FloatArray]:
    """Counterclockwise rings (n, 2): the face's own, or those of triangles where it has holes."""
    import shapely

    shapes = [face] if not face.interiors else shapely.get_parts(shapely.constrained_delaunay_triangles(face))
    return [shapely.get_coordinates(shapely.orient_polygons(shape).exterior)[:-1] for shape in shapes]


def _assignment(middle: Any, border: Any, creases: list[tuple[Any, str]]) -> str:
    for line, assignment in creases:
        if line.distance(middle) < 2 * SAME:
            return assignment
    return "B" if border.distance(middle) < 2 * SAME else "J"


def _folding(layout: Layout, sweep: Sweep | None) -> Iterator[dict[str, Any]]:
    """The open pose, and the frames that inherit from it."""
    mesh, owners = _Mesh(), []
    for part in layout.parts.values():
        for ring in _without_holes(part.polygon):
            mesh.add(part.plane.lift(ring), part.id, ["B"] * len(ring))
            owners.append(part.id)
    yield {
        "frame_title": "open pop-up",
        "frame_classes": ["foldedForm"],
        "frame_attributes": ["3D"],
        **mesh.data(),
        "faces_popsim:part": owners,
        "popsim:glue": _glue(layout),
    }
    if sweep is not None:
        opened = np.array(mesh.vertices)
        moved = np.array([sweep.index[layout.parts[group].patch.id] for group in mesh.groups])
        for frame in _frames(sweep):
            poses = sweep.poses[frame, moved]
            places = (poses[:, :3, :3] @ opened[..., None])[..., 0] + poses[:, :3, 3]
            yield {
                "frame_parent": OPEN_FRAME,
                "frame_inherit": True,
                "frame_title": f"fold angle {sweep.degrees[frame]:.0f}",
                "popsim:fold_angle": round(float(sweep.degrees[frame]), DECIMALS),
                "vertices_coords": (np.round(places, DECIMALS) + 0.0).tolist(),
            }


def _frames(sweep: Sweep) -> list[int]:
    """Positions of the recorded angles nearest to every STEP degrees on the way down, without the open card."""
    closing = sweep.degrees[: sweep.closed + 1]
    wanted = np.arange(180.0 - STEP, -1e-9, -STEP)
    return sorted({int(np.abs(closing - angle).argmin()) for angle in wanted} - {0})


def _glue(layout: Layout) -> list[dict[str, Any]]:
    """What is glued where."""
    return [
        {
            "number": layout.numbers[flap.joint.id],
            "joint": flap.joint.id,
            "flap_on": flap.carrier,
            "glued_to": flap.target,
            "line": np.round(flap.joint.stretches[flap.stretch], DECIMALS).tolist(),
        }
        for flap in layout.flaps
    ]
