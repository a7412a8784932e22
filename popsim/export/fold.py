"""FOLD 1.2: crease patterns of the pieces and the folding of the pop-up, for the tools of the origami community.

One file is the whole design. Its own frame holds the crease patterns of all pieces as they lie on the sheets,
sheets side by side, with `faces_vertices`, and how far each crease is bent while the card stands at 90 degrees:
then none is flat, and tools that fold crease patterns show the piece half closed. Patterns are in triangles made
for such tools (`popsim.export.crease_pattern`), true to 0.2 mm; what a cutter needs is in the other formats. The
first of the other frames is the open pose: one face per part (triangles where it has holes), with `popsim:` keys
for what each face is and what is glued where. Frames that inherit from it are the card at smaller fold angles.
Beside it each piece has a file of its own with its crease pattern, for tools that load single sheets.
"""

import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from popsim.export.crease_pattern import BORDER, CUT, WITHIN, Edge, ordered, triangles, triangulated
from popsim.export.job import Job
from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import move
from popsim.layout import Crease, Fold, Layout, Piece, Placement
from popsim.simulation import Sweep

if TYPE_CHECKING:
    from shapely.geometry import Polygon

SAME = 0.01
"""mm; corners this close are one vertex."""

DECIMALS = 6

BETWEEN_SHEETS = 10.0
"""mm between two sheets."""

STEP = 15.0
"""Degrees between the frames of the folding."""

OPEN_FRAME = 1
"""Number of the frame of the open pose; the file's own is 0."""

HALF_OPEN = 90.0
"""Fold angle of the card, degrees, at which creases are as bent as `edges_foldAngle` says."""

ASSIGNMENT = {Crease.MOUNTAIN: "M", Crease.VALLEY: "V", Crease.NONE: "F"}
BENT = {Crease.MOUNTAIN: -1.0, Crease.VALLEY: 1.0, Crease.NONE: 0.0}
"""Sign of the fold angle, as FOLD has it."""


def write_fold(job: Job, path: Path) -> tuple[Path, ...]:
    """Write one FOLD file of the whole design and one per piece; the same layout gives the same bytes."""
    bends = _Bends(job.layout, job.sweep)
    whole = _pattern(job.title, "pieces as cut", job.layout, job.layout.placements, bends)
    files = {path: whole | {"file_classes": ["singleModel"], "file_frames": list(_folding(job.layout, job.sweep))}}
    for placement in job.layout.placements:
        name = placement.piece.name
        own = path.with_name(f"{path.stem}-{name.replace('/', '-')}{path.suffix}")
        files[own] = _pattern(f"{job.title}, {name}", name, job.layout, (placement,), bends)
    for file, content in files.items():
        file.write_text(json.dumps(content, allow_nan=False, separators=(",", ":")) + "\n", encoding="utf-8")
    return tuple(files)


class _Bends:
    """How far creases are bent while the card is half open."""

    def __init__(self, layout: Layout, sweep: Sweep | None) -> None:
        self._layout, self._sweep = layout, sweep

    def angle(self, fold: Fold) -> float | None:
        """Fold angle of a crease, degrees, negative for mountains; None where no motion is known."""
        if self._sweep is None:
            return None
        one, other = (self._normal(name) for name in fold.parts)
        cosine = np.clip(one @ other * fold.face.value, -1.0, 1.0)
        return round(BENT[fold.crease] * float(np.degrees(np.arccos(cosine))), DECIMALS)

    def _normal(self, name: str) -> FloatArray:
        """To the printed side of a part."""
        assert self._sweep is not None
        part, closing = self._layout.parts[name], self._sweep.degrees[: self._sweep.closed + 1]
        pose = self._sweep.poses[int(np.abs(closing - HALF_OPEN).argmin()), self._sweep.index[part.patch.id]]
        return np.asarray(pose[:3, :3] @ part.plane.normal)


def _pattern(
    title: str, frame: str, layout: Layout, placements: tuple[Placement, ...], bends: _Bends
) -> dict[str, Any]:
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
        **_crease_pattern(layout, placements, bends),
    }


class _Mesh:
    """Vertices, each once per group, with the edges and faces between them."""

    def __init__(self) -> None:
        self.vertices: list[list[float]] = []
        self.groups: list[str] = []
        self.faces: list[list[int]] = []
        self.edges: dict[tuple[int, int], Edge] = {}
        self._index: dict[tuple[Any, ...], int] = {}

    def add(self, ring: FloatArray, group: str, edges: list[Edge]) -> None:
        """Add a face (n, d) and its edges; vertices are shared within `group`."""
        corners = [self._vertex(point, group) for point in ring]
        self.faces.append(corners)
        for ends, edge in zip(_around(corners), edges, strict=True):
            self.edges.setdefault(ends, edge)

    def cut(self) -> None:
        """Give the faces on both sides of cuts corners of their own: then a cut is two borders.

        Borders that run into each other are a cut too, what ends at one face is a border, and where both ends of a
        cut hold, it is left out.
        """
        whole = {edge for edge, what in self.edges.items() if what not in (CUT, BORDER)}
        around: dict[int, list[int]] = {}
        for number, face in enumerate(self.faces):
            for corner in face:
                around.setdefault(corner, []).append(number)
        renamed: dict[tuple[int, int], int] = {}
        for corner, faces in around.items():
            for group in self._held(corner, faces, whole)[1:]:
                self.vertices.append(self.vertices[corner])
                self.groups.append(self.groups[corner])
                renamed |= {(number, corner): len(self.vertices) - 1 for number in group}
        edges, self.edges = self.edges, {}
        faced: Counter[tuple[int, int]] = Counter()
        for number, face in enumerate(self.faces):
            self.faces[number] = [renamed.get((number, corner), corner) for corner in face]
            for old, new in zip(_around(face), _around(self.faces[number]), strict=True):
                self.edges.setdefault(new, edges[old])
                faced[new] += 1
        self.edges = {
            edge: BORDER if faced[edge] == 1 else WITHIN if what == CUT else what
            for edge, what in self.edges.items()
        }

    def _held(self, corner: int, faces: list[int], whole: set[tuple[int, int]]) -> list[list[int]]:
        """The faces around a corner, those together that hang together there by edges that are not cut."""
        sides = {
            number: {edge for edge in _around(self.faces[number]) if corner in edge} & whole for number in faces
        }
        groups: list[list[int]] = []
        for number in faces:
            touched = [group for group in groups if any(sides[number] & sides[other] for other in group)]
            groups = [group for group in groups if group not in touched]
            groups.append([*(other for group in touched for other in group), number])
        return groups

    def data(self) -> dict[str, Any]:
        angles = [edge.angle for edge in self.edges.values()]
        return {
            "vertices_coords": self.vertices,
            "edges_vertices": [list(key) for key in self.edges],
            "edges_assignment": [edge.assignment for edge in self.edges.values()],
            **({} if None in angles else {"edges_foldAngle": angles}),
            "faces_vertices": self.faces,
        }

    def _vertex(self, point: FloatArray, group: str) -> int:
        key = (group, *(int(v) for v in np.round(point / SAME)))
        if key not in self._index:
            self._index[key] = len(self.vertices)
            self.vertices.append([float(v) for v in np.round(point, DECIMALS) + 0.0])
            self.groups.append(group)
        return self._index[key]


def _around(face: list[int]) -> list[tuple[int, int]]:
    """The edges of a face, each from its lower vertex."""
    return [ordered(a, b) for a, b in zip(face, face[1:] + face[:1], strict=True)]


def _crease_pattern(layout: Layout, placements: tuple[Placement, ...], bends: _Bends) -> dict[str, Any]:
    mesh = _Mesh()
    owners = []
    for placement in placements:
        shift = np.array([placement.sheet * (layout.paper.width + BETWEEN_SHEETS), 0.0])
        for ring, edges in _triangles(placement.piece, bends):
            mesh.add(move(placement.motion, ring) + shift, placement.piece.name, edges)
            owners.append(placement.piece.name)
    mesh.cut()
    return {**mesh.data(), "faces_popsim:piece": owners}


def _triangles(piece: Piece, bends: _Bends) -> Iterator[tuple[FloatArray, list[Edge]]]:
    """What outline, slits and creases of a piece enclose: triangles (3, 2), with what each edge is."""
    import shapely

    found = triangles(
        piece.outline,
        [
            (shapely.LineString(fold.ends), Edge(ASSIGNMENT[fold.crease], bends.angle(fold)))
            for fold in piece.folds
        ],
        [shapely.LineString(slit) for slit in piece.slits],
    )
    for face in found.faces.tolist():
        yield found.corners[face], [found.edges.get(edge, WITHIN) for edge in _around(face)]


def _rings(face: "Polygon") -> list[FloatArray]:
    """Counterclockwise rings (n, 2): the face's own, or those of triangles where it has holes."""
    import shapely

    if face.interiors:
        return triangulated(face)
    return [shapely.get_coordinates(shapely.orient_polygons(face).exterior)[:-1]]


def _folding(layout: Layout, sweep: Sweep | None) -> Iterator[dict[str, Any]]:
    """The open pose, and the frames that inherit from it."""
    mesh, owners = _Mesh(), []
    for part in layout.parts.values():
        for ring in _rings(part.polygon):
            mesh.add(part.plane.lift(ring), part.id, [BORDER] * len(ring))
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
