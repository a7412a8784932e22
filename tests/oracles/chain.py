"""Second opinion on the kinematics: a closed chain of hinges solved by least squares, without MuJoCo.

Patches hang on ground and backdrop by a spanning forest of hinges; the unknowns are the angles of its hinges.
Every other hinge closes a loop: its ends must be at one place, whichever of its two patches carries them. The
solution is continued from angle to angle, starting near the open pose with each flat crease bent to its own side.
It knows patches and hinges only, nothing of mechanisms.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from popsim.design import BACKDROP_ID, GROUND_ID, Design, Hinge, Patch

FIRST_STEP = np.radians(2.0)
"""How far from the open pose the first solution is: there the flat creases have made up their mind."""

LONGEST_STEP = np.radians(10.0)
"""Between solutions; extrapolation carries the rest."""


@dataclass(frozen=True)
class Link:
    """A hinge of the forest: the child turns about it relative to the parent."""

    parent: str
    child: str
    hinge: Hinge

    @property
    def axis(self) -> tuple[np.ndarray, np.ndarray]:
        """Point and unit direction, open pose."""
        start, end = np.array(self.hinge.axis)
        return start, (end - start) / np.linalg.norm(end - start)


class Chain:
    """The patches of a design as a forest of links with loops."""

    def __init__(self, design: Design) -> None:
        self.design = design
        self.links = _forest(design)
        self.parent = {link.child: (index, link) for index, link in enumerate(self.links)}
        in_forest = {id(link.hinge) for link in self.links}
        self.loops = [h for h in design.hinges if id(h) not in in_forest and h.kind != "central"]

    def poses(self, angles: np.ndarray, theta: float) -> dict[str, np.ndarray]:
        """Motion of every patch from the open pose, (4, 4), by id."""
        poses = {GROUND_ID: _page(1, theta), BACKDROP_ID: _page(-1, theta)}
        for link, angle in zip(self.links, angles, strict=True):
            poses[link.child] = poses[link.parent] @ _turn(*link.axis, angle)
        return poses

    def gaps(self, angles: np.ndarray, theta: float) -> np.ndarray:
        """Differences of all loop hinge ends, flat, mm."""
        poses = self.poses(angles, theta)
        found = []
        for hinge in self.loops:
            ends = np.array(hinge.axis)
            first, second = (ends @ poses[p][:3, :3].T + poses[p][:3, 3] for p in hinge.patches)
            found.append((first - second).ravel())
        return np.concatenate(found) if found else np.zeros(0)

    def jacobian(self, angles: np.ndarray, theta: float) -> np.ndarray:
        """Derivative of the gaps by the angles, mm per radian."""
        poses, matrix = self.poses(angles, theta), np.zeros((6 * len(self.loops), len(angles)))
        for row, hinge in enumerate(self.loops):
            for sign, patch in zip((1, -1), hinge.patches, strict=True):
                ends = np.array(hinge.axis) @ poses[patch][:3, :3].T + poses[patch][:3, 3]
                for index, link in self._ancestry(patch):
                    point, direction = link.axis
                    turn = poses[link.parent]
                    axis, origin = turn[:3, :3] @ direction, turn[:3, :3] @ point + turn[:3, 3]
                    matrix[6 * row : 6 * row + 6, index] += sign * np.cross(axis, ends - origin).ravel()
        return matrix

    def _ancestry(self, patch: str) -> Iterator[tuple[int, Link]]:
        """The links from a patch down to a page, with their positions."""
        while patch in self.parent:
            yield self.parent[patch]
            patch = self.parent[patch][1].parent

    def free_motions(self, angles: np.ndarray, theta: float, least: float = 1e-6) -> int:
        """How many ways it can move with the pages held: singular values below `least` of the greatest."""
        values = np.linalg.svd(self.jacobian(angles, theta), compute_uv=False)
        return len(angles) - int((values > least * values.max()).sum())

    def fold(self, theta: Iterable[float]) -> list[tuple[dict[str, np.ndarray], float, int]]:
        """Poses, largest gap (mm) and free motions at falling fold angles (radians), the first below pi."""
        now = np.pi - FIRST_STEP
        angles = self._solve(np.array([_bent(link, self.design.patches, FIRST_STEP) for link in self.links]), now)
        before, last, found = np.array([0.0 for _ in self.links]), np.pi, []
        for goal in theta:
            while now - goal > 1e-12:
                step = min(LONGEST_STEP, now - goal)
                guess = angles + (angles - before) * step / (last - now)
                before, last, now = angles, now, now - step
                angles = self._solve(guess, now)
            gap = float(np.abs(self.gaps(angles, now)).max(initial=0.0))
            found.append((self.poses(angles, now), gap, self.free_motions(angles, now)))
        return found

    def _solve(self, guess: np.ndarray, theta: float) -> np.ndarray:
        if not self.loops:
            return guess
        solved = least_squares(
            self.gaps, guess, self.jacobian, args=(theta,), method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15
        )
        return solved.x


def _forest(design: Design) -> list[Link]:
    """Links from the pages outward; flat creases come first, so that they can be bent to their side."""
    known, links = {GROUND_ID, BACKDROP_ID}, []
    hinges = [hinge for hinge in design.hinges if hinge.kind != "central"]
    while len(known) < len(design.patches):
        reach = [hinge for hinge in hinges if len(known.intersection(hinge.patches)) == 1]
        hinge = min(reach, key=lambda hinge: hinge.crease is None)
        parent, child = hinge.patches if hinge.patches[0] in known else hinge.patches[::-1]
        links.append(Link(parent, child, hinge))
        known.add(child)
    return links


def _bent(link: Link, patches: Iterable[Patch], by: float) -> float:
    """Angle of a link that bends a flat crease by `by` to its own side; 0 for others."""
    if link.hinge.crease is None:
        return 0.0
    _, axis = link.axis
    start, end = np.array(link.hinge.axis)
    outline = np.array(next(patch.outline for patch in patches if patch.id == link.child))
    inward = outline.mean(axis=0) - (start + end) / 2
    return by * float(np.sign(np.cross(axis, inward) @ -np.array(link.hinge.crease)))


def _page(sign: int, theta: float) -> np.ndarray:
    """Motion of a page: it turns about the x axis from y to z."""
    return _turn(np.zeros(3), np.array([1.0, 0.0, 0.0]), sign * (np.pi - theta) / 2)


def _turn(point: np.ndarray, axis: np.ndarray, angle: float) -> np.ndarray:
    """Rotation by `angle` about a line (Rodrigues), (4, 4)."""
    x, y, z = axis
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    motion = np.eye(4)
    motion[:3, :3] += np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew
    motion[:3, 3] = point - motion[:3, :3] @ point
    return motion
