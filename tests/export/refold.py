"""Folding cut-outs back into a pop-up by nothing but what is printed on them; shares no code with the writers.

Faces are what cuts and creases enclose. A crease turns towards the reader or away, as its line says. A flap
bears a number, and so does its place: drawn on the front, or on the reverse of the sheet. Glued, the flap lies
on its place, and its carrier goes on from the crease on that side of the paper. What is unknown are the angles
of the creases; they are found by closing all glue joints, with the card half open first.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import networkx
import numpy as np
import shapely
from rebuild import faces, fits_onto
from scipy.optimize import least_squares
from sheet_readers import Side

HALF_OPEN = (120.0, 140.0, 160.0, 170.0, 176.0, 179.0, 180.0)
"""Fold angles of the card, degrees; each starts from the one before."""

BESIDE = 6
"""Faces near a number that it can mean."""

NEAR = 0.05
"""mm."""


@dataclass(frozen=True)
class Crease:
    """Two faces, the ends of their crease (2, 2), and 1 for a valley, -1 for a mountain."""

    faces: tuple[int, int]
    ends: np.ndarray
    sign: int


@dataclass(frozen=True)
class Glue:
    """A flap (a face), the face it is glued to, and where in its sheet coordinates the flap's go, (4, 4)."""

    flap: int
    target: int
    motion: np.ndarray


@dataclass(frozen=True)
class Paper:
    """Everything that is read off two-sided sheets; sheets lie side by side."""

    faces: list[shapely.Polygon]
    creases: list[Crease]
    glue: list[Glue]

    @property
    def flaps(self) -> set[int]:
        return {joint.flap for joint in self.glue}


def read_paper(sides: list[Side], width: float) -> Paper:
    """Sheets of `width` mm, each followed by its reverse."""
    found: list[shapely.Polygon] = []
    creases: list[Crease] = []
    flaps: dict[str, list[tuple[int, shapely.Point]]] = {}
    places: dict[str, list[tuple[int, shapely.Polygon, int]]] = {}
    for number, (front, back) in enumerate(zip(sides[::2], sides[1::2], strict=True)):
        first, shift = len(found), np.array([2 * number * width, 0.0])
        found += [shapely.transform(face, lambda xy, s=shift: xy + s) for face in faces(front)]
        own = found[first:]
        for sign, lines in ((1, front.valley), (-1, front.mountain)):
            creases += [crease for line in lines for crease in _creases(line + shift, sign, own, first)]
        landings = [(shapely.transform(area, lambda xy, s=shift: xy + s), 1) for area in front.glue]
        landings += [
            (shapely.transform(area, lambda xy, s=shift: [width, 0] + xy * [-1, 1] + s), -1) for area in back.glue
        ]
        spots = [(text, spot + shift, 1) for text, spot in front.texts]
        spots += [(text, [width, 0] + spot * [-1, 1] + shift, -1) for text, spot in back.texts]
        for text, spot, side in spots:
            word = text.split(" ")[0]
            if not word.isdigit():
                continue
            point = shapely.Point(spot)
            area = next((area for area, face in landings if face == side and area.contains(point)), None)
            holder = next((k for k, face in enumerate(own, first) if face.contains(point)), None)
            if area is not None and holder is not None:
                places.setdefault(word, []).append((holder, area, side))
            elif holder is not None:
                flaps.setdefault(word, []).append((holder, point))
    bends = {face: crease.sign for crease in creases for face in crease.faces}
    glue: list[Glue] = []
    for word, labelled in flaps.items():
        joints = _glued([(k, found[k]) for k, _ in labelled], places[word], bends)
        if not joints:  # a number beside its flap, which is too small for it
            beside = sorted(bends, key=lambda k: found[k].distance(labelled[0][1]))[:BESIDE]  # at once
            tried = [_glued([(k, found[k])], places[word], bends) for k in beside]
            joints = next((joints for joints in tried if joints), [])
        assert joints, f"the flap {word} fits none of its places"
        glue += joints
    return Paper(found, creases, glue)


def _creases(line: np.ndarray, sign: int, own: list[shapely.Polygon], first: int) -> Iterator[Crease]:
    middle = shapely.Point(line.mean(axis=0))
    beside = [k for k, face in enumerate(own, first) if face.distance(middle) < NEAR]
    if len(beside) == 2:  # a sample in the legend has paper on no side
        yield Crease((beside[0], beside[1]), line[[0, -1]], sign)


def _glued(
    flaps: list[tuple[int, shapely.Polygon]],
    places: list[tuple[int, shapely.Polygon, int]],
    bends: dict[int, int],
) -> list[Glue]:
    """All flaps of one number on their places: they hang on one line, so one motion takes all of them there.

    None if they do not fit.
    """
    (first, shape), *_ = flaps
    for target, area, side in places:
        same = side * bends[first] > 0  # the carrier goes on from the flap on the side where the flap lies
        for mirrored in (not same, same):  # or else it comes round the edge
            start = np.diag([-1.0 if mirrored else 1.0, 1.0, 1.0])
            for motion in fits_onto(area, _moved(shape, start)):
                flat = motion @ start
                landed = [_moved(flap, flat) for _, flap in flaps]
                if all(min(p.hausdorff_distance(spot) for _, p, _ in places) < NEAR for spot in landed):
                    space = np.eye(4)
                    space[:2, :2], space[:2, 3] = flat[:2, :2], flat[:2, 2]
                    space[2, 2] = -1.0 if mirrored else 1.0
                    return [Glue(face, target, space) for face, _ in flaps]
    return []


def _moved(shape: shapely.Polygon, motion: np.ndarray) -> shapely.Polygon:
    return shapely.transform(shape, lambda spots: spots @ motion[:2, :2].T + motion[:2, 2])


class Refolded:
    """Paper folded back; poses (4, 4) of all faces from sheet coordinates, the largest face in its place."""

    def __init__(self, paper: Paper) -> None:
        self.paper = paper
        by_area = sorted(range(len(paper.faces)), key=lambda k: -paper.faces[k].area)
        self.root, self.other = by_area[:2]
        lies_on = {joint.flap: joint.target for joint in paper.glue}
        pages = {self.root, self.other}
        self.central = next(
            k for k, crease in enumerate(paper.creases) if {lies_on.get(f, f) for f in crease.faces} == pages
        )
        self.signs = np.array([crease.sign for crease in paper.creases])

    @cached_property
    def plan(self) -> tuple[list[tuple[str, int, int, int]], list[Glue]]:
        """How each face is reached from one before, by a crease or by glue, and the glue that is left to close."""
        graph = networkx.MultiGraph()
        graph.add_nodes_from(range(len(self.paper.faces)))
        for kind, joints in (("crease", self.paper.creases), ("glue", self.paper.glue)):
            for number, joint in enumerate(joints):
                ends = joint.faces if isinstance(joint, Crease) else (joint.target, joint.flap)
                graph.add_edge(*ends, key=(kind, number))
        steps, used, reached = [], set(), {self.root}
        while len(reached) < len(graph):
            edge = min(
                (key[0], key[1], a, b)
                for a in reached
                for b in graph[a]
                if b not in reached
                for key in graph[a][b]
            )
            steps.append(edge)
            used.add(edge[:2])
            reached.add(edge[3])
        return steps, [joint for k, joint in enumerate(self.paper.glue) if ("glue", k) not in used]

    def poses(self, angles: np.ndarray) -> np.ndarray:
        """Poses (f, m, 4, 4) for crease angles (m, c)."""
        found = np.tile(np.eye(4), (len(self.paper.faces), len(angles), 1, 1))
        for kind, number, start, end in self.plan[0]:
            if kind == "crease":
                found[end] = found[start] @ self._turn(self.paper.creases[number], end, angles[:, number])
            else:
                joint = self.paper.glue[number]
                motion = joint.motion if end == joint.flap else np.linalg.inv(joint.motion)
                found[end] = found[start] @ motion
        return found

    def _turn(self, crease: Crease, moved: int, angles: np.ndarray) -> np.ndarray:
        """Turn about a crease that lifts face `moved` for positive angles, (m, 4, 4)."""
        start, end = crease.ends
        middle = crease.ends.mean(axis=0)
        along = (end - start) / np.linalg.norm(end - start)
        beside = middle + 0.1 * np.array([-along[1], along[0]])
        if not self.paper.faces[moved].contains(shapely.Point(beside)):
            along = -along
        axis = np.array([along[0], along[1], 0.0])
        cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
        sin, cos = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
        turn = np.eye(3) + sin * cross + (1 - cos) * (cross @ cross)
        poses = np.tile(np.eye(4), (len(angles), 1, 1))
        spot = np.array([*middle, 0.0])
        poses[:, :3, :3], poses[:, :3, 3] = turn, spot - turn @ spot
        return poses

    def gaps(self, angles: np.ndarray) -> np.ndarray:
        """How far the flaps left to close are off their places, mm, (m, k)."""
        found = self.poses(angles)
        gaps = []
        for joint in self.plan[1]:
            corners = np.array(self.paper.faces[joint.flap].exterior.coords)[:3]
            spots = np.column_stack([corners, np.zeros(3), np.ones(3)])
            there = found[joint.target] @ joint.motion
            gaps.append(((found[joint.flap] - there) @ spots.T)[:, :3].reshape(len(angles), -1))
        return np.concatenate(gaps, axis=1)

    def opened(self) -> np.ndarray:
        """Poses (f, 4, 4) with the card fully open."""
        free = np.flatnonzero(np.arange(len(self.signs)) != self.central)
        angles = self.signs * np.pi / 2
        for theta in HALF_OPEN:
            angles[self.central] = np.pi - np.radians(theta)
            angles[free] = self._closed(angles, free)
        worst = np.abs(self.gaps(angles[None])).max()
        assert worst < NEAR, f"glue joints stay open by {worst:.3f} mm"
        return self.poses(angles[None])[:, 0]

    def _closed(self, angles: np.ndarray, free: np.ndarray) -> np.ndarray:
        step = 1e-7

        def full(values: np.ndarray) -> np.ndarray:
            made = angles.copy()
            made[free] = values
            return made

        def jacobian(values: np.ndarray) -> np.ndarray:
            tried = np.array([full(values + step * row) for row in np.eye(len(free))])
            return (self.gaps(tried) - self.gaps(full(values)[None])).T / step

        bounds = (np.where(self.signs > 0, -1e-3, -np.pi)[free], np.where(self.signs > 0, np.pi, 1e-3)[free])
        start = np.clip(angles[free], bounds[0] + 1e-6, bounds[1] - 1e-6)
        return least_squares(
            lambda values: self.gaps(full(values)[None])[0],
            start,
            jacobian,
            bounds=bounds,
            xtol=1e-14,
            ftol=1e-14,
            gtol=1e-14,
        ).x


def ring(face: shapely.Polygon) -> np.ndarray:
    """Points along the outline of a face, no more than a millimetre apart, (n, 2)."""
    corners = np.array(face.exterior.coords)
    parts = [np.linspace(a, b, int(np.linalg.norm(b - a)) + 2)[:-1] for a, b in pairwise(corners)]
    return np.concatenate(parts)
