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

SPOKES = 6
"""Rays around the axis of a finger or a hand."""

TILTS = (0.0, 30.0, 55.0)
"""Degrees between a pressing finger and the normal of the paper: beyond that it slips off."""


class Surroundings:
    """Parts at one moment: outlines of all parts, by id, and where those that are there lie.

    `poses` are motions of these parts from the open pose, by part id, each of shape (4, 4).
    """

    def __init__(self, outlines: Mapping[str, Outline], poses: Mapping[str, FloatArray]) -> None:
        there = [outlines[name] for name in poses]
        motions = np.array(list(poses.values())).reshape(-1, 4, 4)
        frames = np.array([own.frame for own in there]).reshape(-1, 4, 3) @ motions[:, :3, :3].swapaxes(1, 2)
        self._opaque = np.array([own.opaque for own in there], dtype=object)
        self._axes, self._normals = frames[:, :2], frames[:, 2]
        self._origins = frames[:, 3] + motions[:, :3, 3]
        self._offsets = (self._normals * self._origins).sum(axis=1)
        self._middles = np.array([own.middle for own in there]).reshape(-1, 2)
        self._radii = np.array([own.radius for own in there])

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
        """Whether something of a radius, with a hand behind it, comes to a spot (3,) along one of `directions`."""
        whole = np.full(len(directions), ARM - LIFT)
        free = directions[~self.blocked(spot + LIFT * directions, directions, whole)]
        along, rings = free[:, None], _rings(free)
        starts = np.concatenate(
            [spot + radius * rings + radius * along, spot + HAND * rings + REACH * along], axis=1
        )
        lengths = np.tile(np.repeat([REACH - radius, ARM - REACH], SPOKES), len(free))
        rays = np.broadcast_to(along, starts.shape)
        hit = self.blocked(starts.reshape(-1, 3), rays.reshape(-1, 3), lengths)
        return not hit.reshape(-1, 2 * SPOKES).any(axis=1).all()

    def blocked(self, starts: FloatArray, rays: FloatArray, lengths: FloatArray) -> BoolArray:
        """Which rays from `starts` along unit `rays` (n, 3) meet paper within `lengths` (n,), shape (n,)."""
        import shapely

        with np.errstate(divide="ignore", invalid="ignore"):
            distance = (self._offsets - starts @ self._normals.T) / (rays @ self._normals.T)
            ray, part = np.nonzero((distance > 1e-9) & (distance < lengths[:, None]))
        spots = starts[ray] + distance[ray, part, None] * rays[ray] - self._origins[part]
        flat = (self._axes[part] @ spots[:, :, None])[..., 0]
        near = ((flat - self._middles[part]) ** 2).sum(axis=1) <= self._radii[part] ** 2
        ray, part, flat = ray[near], part[near], flat[near]
        hit = np.zeros(len(starts), dtype=bool)
        hit[ray[shapely.contains_xy(self._opaque[part], flat[:, 0], flat[:, 1])]] = True
        return hit


def _off(normal: FloatArray) -> FloatArray:
    """Directions off paper with a unit normal, shape (k, 3)."""
    rays = sphere_directions(RAYS)
    return np.asarray(rays[rays @ normal > GRAZING])


def _cone(normal: FloatArray) -> FloatArray:
    """Directions within a finger's tilt of a unit normal, shape (k, 3)."""
    ring = _rings(normal[None])[0]
    tilted = [np.cos(tilt) * normal + np.sin(tilt) * ring for tilt in np.radians(TILTS[1:])]
    return np.concatenate([normal[None], *tilted])


def _rings(directions: FloatArray) -> FloatArray:
    """Unit vectors around each of some unit directions (n, 3), shape (n, SPOKES, 3)."""
    first, second = across(directions)
    turn = np.linspace(0, 2 * np.pi, SPOKES, endpoint=False)[:, None]
    return np.asarray(np.cos(turn) * first[:, None] + np.sin(turn) * second[:, None])
