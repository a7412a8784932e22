"""Where on a plate the model will show once contours are cut, on a grid in its plane."""

from dataclasses import dataclass

import numpy as np

from popsim.fitting.fronts import Fronts
from popsim.geometry.arrays import BoolArray, FloatArray, IntArray
from popsim.geometry.plane import Plane
from popsim.mechanisms import Plate

SPARSE = 0.25
"""A face on which the model shows on less than this share stays whole: its hinges need paper to hold."""

LEVEL = 0.5
"""A plate whose normal rises by more lies, and has no foot."""

RECTANGLE, STRAIGHT = 4, 1e-9
"""Corners of a rectangle along the axes, and by how little, mm, its edges leave them."""


@dataclass(frozen=True, eq=False)
class Stencil:
    """Cells of the plane of a plate.

    Attributes
    ----------
    plane:
        The plane.
    outline:
        Face of the plate in the plane, shape (n, 2).
    low, grain:
        Corner where the cells start, shape (2,), and their side, mm.
    face, beyond:
        Whether the plate shows the model at a cell, were it in the face, or beyond it; indexed by u and v.
    """

    plane: Plane
    outline: FloatArray
    low: FloatArray
    grain: float
    face: BoolArray
    beyond: BoolArray

    @staticmethod
    def of(plate: Plate, plane: Plane, corners: FloatArray, fronts: Fronts, grain: float) -> "Stencil":
        """Hold a plate against a model.

        Within the face what lies no deeper shows, and what that encloses; beyond the face what lies near, but not
        what hangs in the air there or is but a seam along the face. Patches inside show what both sides hide.

        Parameters
        ----------
        plate, plane:
            The plate and its plane.
        corners:
            Around all that can show, shape (n, 3).
        fronts:
            The model.
        grain:
            Side of the cells, mm.
        """
        assert plate.room is not None  # plates give themselves room
        flat = plane.flat(corners)
        low = flat.min(axis=0) - grain
        shape = np.ceil((flat.max(axis=0) - low) / grain).astype(np.int64) + 1
        cells = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 2)
        centres = low + (cells + 0.5) * grain
        points = plane.lift(centres)
        outline, room = plane.flat(plate.outline), plane.flat(plate.room)
        own = within(centres, outline)
        free = ~own & within(centres, room)
        behind = fronts.behind(points, plate.outward)
        shown, near, there = behind <= plate.behind, behind <= plate.beside, np.isfinite(behind)
        if not plate.principal:
            other = fronts.behind(points, -plate.outward)
            shown = there & np.isfinite(other)
            near = near & (other <= plate.beside)
            there = there | np.isfinite(other)
        face, inside, beyond, there = (each.reshape(shape) for each in (shown & there, own, near & free, there))
        if (there & inside & ~face).any():
            walls = _walls(plate, points[:, 1].reshape(shape), inside)
            face = face | (_enclosed((face & inside) | beyond, walls) & inside & there)
        if plate.principal and (face & inside).sum() < SPARSE * inside.sum():
            face = np.ones_like(face)
        return Stencil(plane, outline, low, grain, face, _attached(face & inside, inside, beyond))

    def shows(self, points: FloatArray) -> BoolArray:
        """At which points (n, 3) of the plane the model shows."""
        flat = self.plane.flat(points)
        own = within(flat, self.outline)
        cells: IntArray = np.floor((flat - self.low) / self.grain).astype(np.int64)
        x, y = np.clip(cells, 0, np.array(self.face.shape) - 1).T
        return np.asarray(np.where(own, self.face[x, y], self.beyond[x, y]))


def _walls(plate: Plate, y: FloatArray, inside: BoolArray) -> BoolArray:
    """Cells at the foot of an upright face, and those over the fold, where it goes on on the other side.

    `y` and `inside` are of all cells: how far from the fold, and whether in the face.
    """
    walls = np.zeros(inside.shape, dtype=bool)
    columns, rows = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    if not len(columns):
        return walls
    across, along = slice(columns[0], columns[-1] + 1), slice(rows[0], rows[-1] + 1)
    if abs(plate.outward[2]) < LEVEL:
        walls[across, max(rows[0] - 1, 0)] = True
    if abs(plate.outward[1]) < LEVEL:
        beyond = np.sign(plate.outline[:, 1].sum()) * y <= 0
        walls[_widened(across), along] |= beyond[_widened(across), along]
        walls[across, _widened(along)] |= beyond[across, _widened(along)]
    return walls


def _widened(span: slice) -> slice:
    """A span and a cell at either end."""
    return slice(max(span.start - 1, 0), span.stop + 1)


def _enclosed(mask: BoolArray, walls: BoolArray) -> BoolArray:
    """Cells amid a mask and walls."""
    from scipy.ndimage import binary_fill_holes

    return np.asarray(binary_fill_holes(mask | walls)) & ~mask


def _grown(mask: BoolArray, around: bool = False) -> BoolArray:
    """A mask and the cells beside its cells; at their corners too where all `around` is meant."""
    wide = mask.copy()
    wide[1:] |= mask[:-1]
    wide[:-1] |= mask[1:]
    source = wide if around else mask
    grown = wide.copy()
    grown[:, 1:] |= source[:, :-1]
    grown[:, :-1] |= source[:, 1:]
    return grown


def _attached(shown: BoolArray, inside: BoolArray, beyond: BoolArray) -> BoolArray:
    """What hangs together with what a face shows, and is more than a seam along it."""
    from scipy.ndimage import label

    if not beyond.any():
        return beyond
    far = beyond & ~_grown(inside)
    kept = far | (beyond & _grown(far, around=True))
    parts, count = label(_grown(shown | kept))
    joined = np.zeros(count + 1, dtype=bool)
    joined[parts[shown]] = True
    return np.asarray(_grown(kept) & joined[parts])


def within(points: FloatArray, ring: FloatArray) -> BoolArray:
    """Whether points (n, 2) lie in a simple polygon (m, 2)."""
    x, y = points.T
    edges = np.roll(ring, -1, axis=0) - ring
    if len(ring) == RECTANGLE and (np.abs(edges) < STRAIGHT).any(axis=1).all():
        (left, lower), (right, upper) = ring.min(axis=0), ring.max(axis=0)
        return np.asarray((x > left) & (x < right) & (y > lower) & (y < upper))
    inside = np.zeros(len(points), dtype=bool)
    for (x0, y0), (x1, y1) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        if y0 == y1:
            continue
        crosses = (y0 > y) != (y1 > y)
        inside ^= crosses & (x < x0 + (y - y0) * ((x1 - x0) / (y1 - y0)))
    return inside
