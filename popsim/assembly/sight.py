"""What can be seen and where a finger gets to, by rays."""

from collections.abc import Mapping

import numpy as np

from popsim.assembly.outline import Outline
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.directions import across, sphere_directions

LIFT = 0.2
"""mm; rays start this far off the paper."""

RAYS = 64
"""Directions tried from each spot."""

HIDDEN = 0.05
"""What is seen from fewer of these directions than this share is glued blind."""

GRAZING = 0.1
"""Sine of the least angle between a ray and the paper that it leaves."""

FINGER = 6.0
"""mm; radius of a child's forefinger."""

STICK = 1.0
"""mm; radius of a toothpick with glue on it."""

REACH = 35.0
"""mm from the tip to where the hand begins: two joints of that finger, or where a stick is held."""

HAND = 25.0
"""mm; radius that a hand with the other fingers bent takes beyond REACH."""

ARM = 100.0
"""mm; farther along, a hand has room."""

TILTS = (0.0, 30.0, 55.0)
"""Degrees between a pressing finger and the normal of the paper: beyond that it slips off."""


class Surroundings:
    """Parts at one moment.

    Attributes
    ----------
    outlines:
        Of all parts, by id.
    poses:
        Motion of each part that is there from the open pose, by part id, each of shape (4, 4).
    """

    def __init__(self, outlines: Mapping[str, Outline], poses: Mapping[str, FloatArray]) -> None:
        self.outlines = outlines
        self.poses = poses

    def openness(self, spots: FloatArray, normals: FloatArray) -> float:
        """Share of directions off the paper at the best of some spots (n, 3) from which it can be seen.

        `normals`: unit, out of the paper towards the side that is looked at, shape (n, 3).
        """
        best = 0.0
        for spot, normal in zip(spots, normals, strict=True):
            rays = _off(normal)
            starts = np.repeat((spot + LIFT * normal)[None], len(rays), axis=0)
            best = max(best, 1 - float(self.blocked(starts, rays, np.full(len(rays), np.inf)).mean()))
        return best

    def reached(self, spots: FloatArray, normals: FloatArray) -> bool:
        """Whether a finger can press on the paper at one of some spots (n, 3) against its unit normals (n, 3)."""
        return any(self._gets_to(spot, _cone(normal), FINGER) for spot, normal in zip(spots, normals, strict=True))

    def glued(self, spots: FloatArray, normals: FloatArray) -> bool:
        """Whether a stick with glue on it gets to the paper at one of some spots (n, 3), normals (n, 3)."""
        return any(
            self._gets_to(spot + LIFT * normal, _off(normal), STICK)
            for spot, normal in zip(spots, normals, strict=True)
        )

    def _gets_to(self, spot: FloatArray, directions: FloatArray, radius: float) -> bool:
        starts, rays, lengths = [], [], []
        for direction in directions:
            ring = _ring(direction)
            for offset, begin, end in (
                (np.zeros((1, 3)), LIFT, ARM),
                (radius * ring, radius, REACH),
                (HAND * ring, REACH, ARM),
            ):
                starts.append(spot + offset + begin * direction)
                rays.append(np.repeat(direction[None], len(offset), axis=0))
                lengths.append(np.full(len(offset), end - begin))
        hit = self.blocked(np.concatenate(starts), np.concatenate(rays), np.concatenate(lengths))
        return bool((~hit.reshape(len(directions), -1).any(axis=1)).any())

    def blocked(self, starts: FloatArray, rays: FloatArray, lengths: FloatArray) -> BoolArray:
        """Which rays from `starts` along unit `rays` (n, 3) meet paper within `lengths` (n,), shape (n,)."""
        hit = np.zeros(len(starts), dtype=bool)
        for name, pose in self.poses.items():
            outline = self.outlines[name]
            origin = (starts - pose[:3, 3]) @ pose[:3, :3]
            along = rays @ pose[:3, :3]
            height, slope = outline.plane.distance(origin), along @ outline.plane.normal
            with np.errstate(divide="ignore", invalid="ignore"):
                distance = -height / slope
            reached = np.flatnonzero(~hit & np.isfinite(distance) & (distance > 1e-9) & (distance < lengths))
            if len(reached):
                hit[reached] |= outline.hides(origin[reached] + distance[reached, None] * along[reached])
        return hit


def _off(normal: FloatArray) -> FloatArray:
    """Directions off paper with a unit normal, shape (k, 3)."""
    rays = sphere_directions(RAYS)
    return np.asarray(rays[rays @ normal > GRAZING])


def _cone(normal: FloatArray) -> FloatArray:
    """Directions within a finger's tilt of a unit normal, shape (k, 3)."""
    ring = _ring(normal)
    tilted = [np.cos(tilt) * normal + np.sin(tilt) * ring for tilt in np.radians(TILTS[1:])]
    return np.concatenate([normal[None], *tilted])


def _ring(direction: FloatArray) -> FloatArray:
    """Six unit vectors around a unit direction, shape (6, 3)."""
    first, second = across(direction)
    turn = np.linspace(0, 2 * np.pi, 6, endpoint=False)[:, None]
    return np.asarray(np.cos(turn) * first + np.sin(turn) * second)
