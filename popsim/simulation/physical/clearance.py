"""Where thickness closes a gap: plates of their real thickness, in the poses of the rigid sweep.

Each patch is a plate, half the thickness to either side of its plane, up to its outline. A gap counts from the
angle on at which it is open: plates that touch from the start, edge on face or corner on crease, have none, and
are cut to fit. Patches that share a hinge line are left out: there paper gives way.

In the end all layers of a closing card touch. What counts is when: thickness is in the way where two patches touch
long before the others do, and a gap that is clear for paper without thickness is not for real paper.
"""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.geometry.rigid import transform
from popsim.simulation.plates import prisms
from popsim.simulation.scene import Scene
from popsim.simulation.sweep import Sweep

REACH = 10.0
"""Of the thickness; gaps wider than this are not measured."""

ALIKE = 5
"""Decimals of an angle in rad to which pairs that touch alike are told in the order of their names."""

APART = 0.02
"""mm; a gap wider than this is open. Less is rounding, or the play of edges cut to fit."""


@dataclass(frozen=True)
class Touch:
    """Two patches that touch before the card is closed, and the fold angle at which they do, rad.

    Between recorded angles the gap is taken to shrink evenly.
    """

    patches: tuple[str, str]
    theta: float


@dataclass(frozen=True, eq=False)
class Clearance:
    """Gaps between thick plates while the card closes.

    Attributes
    ----------
    theta:
        Fold angles, rad, shape (n,).
    least:
        Narrowest gap between any two patches, mm, negative where they overlap, `most` where none is narrower,
        shape (n,).
    most:
        mm.
    touches:
        Every pair that touches, the earliest first.
    """

    theta: FloatArray
    least: FloatArray
    most: float
    touches: tuple[Touch, ...]


def clearance(sweep: Sweep, frames: list[int], thickness: float) -> Clearance:
    """Measure the gaps at the recorded angles `frames`, from open to closed."""
    most, theta = REACH * thickness, sweep.theta[frames]
    gaps = _gaps(sweep, frames, thickness, most)
    names = [patch.id for patch in sweep.design.patches]
    least, touches = np.full(len(frames), most), []
    for (first, second), measured in gaps.items():
        gap = np.where(np.maximum.accumulate(measured > APART), measured, most)
        least = np.minimum(least, gap)
        if gap.min() < 0:
            touches.append(Touch((names[first], names[second]), _first(theta, gap)))
    touches.sort(key=lambda touch: (-round(touch.theta, ALIKE), touch.patches))
    return Clearance(theta, least, most, tuple(touches))


def _gaps(sweep: Sweep, frames: list[int], thickness: float, most: float) -> dict[tuple[int, int], FloatArray]:
    """Gap of all pairs that come nearer than `most` mm, by their positions, mm, shape (n,) each."""
    scale = float(np.ptp(np.concatenate([patch.points for patch in sweep.design.patches]), axis=0).max())
    skin = thickness / 2 / scale
    plates = {place: prisms(patch, scale, skin) for place, patch in enumerate(sweep.design.patches)}
    scene, joined = Scene(plates, scale), sweep.touching
    gaps: dict[tuple[int, int], FloatArray] = {}
    for row, frame in enumerate(frames):
        scene.place(sweep.poses[frame])
        for first, second in np.argwhere(np.triu(_near(sweep, frame, most + thickness) & ~joined, 1)).tolist():
            gap = gaps.setdefault((first, second), np.full(len(frames), most))
            gap[row] = scene.distance(first, second, most)
    return gaps


def _near(sweep: Sweep, frame: int, most: float) -> BoolArray:
    """Whose boxes are nearer to each other than `most` mm, shape (p, p)."""
    corners = [transform(pose, hull) for pose, hull in zip(sweep.poses[frame], sweep.hulls, strict=True)]
    low = np.array([points.min(axis=0) for points in corners])
    high = np.array([points.max(axis=0) for points in corners]) + most
    return np.asarray((low[:, None] <= high[None]).all(axis=-1) & (low[None] <= high[:, None]).all(axis=-1))


def _first(theta: FloatArray, gap: FloatArray) -> float:
    """Fold angle at which a gap (n,) that was open at first is closed, rad."""
    row = int(np.argmax(gap < 0))
    share = gap[row - 1] / (gap[row - 1] - gap[row])
    return float(theta[row - 1] + share * (theta[row] - theta[row - 1]))
