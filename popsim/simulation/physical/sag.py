"""How far patches sag when the card is open.

Rigid plates do not bend, so this is worked out from the forces measured in them. A patch is taken as a strip of
beam with the bending stiffness of the stock, simply supported at both ends. Its span is twice the distance d of
that point of the patch that is farthest from every hinge that carries it (whose force on the patch acts against
gravity). It bears its own weight, by the part that acts at right angles to it, and in the middle whatever hinges
press on it: l^4 / B (5 q / 384 + F / (48 A)) with span l = 2 d, stiffness B, weight q per area, pressing force F
and area A.

For a strip between two parallel hinges that is exact beam theory (up to small deflections). A plate carried all
round sags about a third of it, an edge that overhangs its hinge by d, clamped there, 0.6 of it: the number is an
upper estimate. Creep, damp, and the bow that springing creases give to a patch are not in it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from popsim.design import Design, Hinge, Patch
from popsim.geometry.arrays import FloatArray
from popsim.simulation.forest import PAGES
from popsim.simulation.physical.loads import Loads, gravity
from popsim.simulation.physical.statics import Balance
from popsim.stock import Stock

UPRIGHT = 0.1
"""Share of gravity at right angles to a patch below which it stands upright, and does not sag."""

SAMPLES = 25
"""Places along either side of a patch at which distances from its hinges are taken."""

CARRIES = 0.1
"""Of the weight of a patch; a hinge that bears less of it does not carry it."""

ON_EDGE = 1e-6
"""mm; places this near to a patch lie on it."""


@dataclass(frozen=True)
class Sag:
    """Of one patch: greatest deflection and the span that gives it, mm, and what hinges press on it with, N."""

    patch: str
    depth: float
    span: float
    load: float


def sags(
    design: Design, poses: FloatArray, theta: float, loads: Loads, measured: Balance, stock: Stock
) -> tuple[Sag, ...]:
    """Sag of every patch that neither stands upright nor is a page on the table, the greatest first.

    Parameters
    ----------
    design, poses, theta:
        What stands in poses (p, 4, 4) at a fold angle, rad.
    loads, measured:
        Its weights, and the hinge forces that carry them.
    stock:
        Gives the stiffness.
    """
    down = gravity(np.array(theta))
    found = []
    for patch, pose, area in zip(design.patches, poses, loads.areas, strict=True):
        across = float(patch.plane.normal @ pose[:3, :3].T @ down)
        if patch.id not in PAGES and abs(across) >= UPRIGHT:
            downward = np.sign(across) * pose[:3, :3] @ patch.plane.normal
            found.append(_sag(design, patch, float(area), abs(across), downward, measured, stock))
    return tuple(sorted(found, key=lambda sag: (-sag.depth, sag.patch)))


def _sag(
    design: Design,
    patch: Patch,
    area: float,
    across: float,
    downward: FloatArray,
    measured: Balance,
    stock: Stock,
) -> Sag:
    """Sag of one patch.

    `downward` is its normal on the side to which gravity pulls it, by `across` of its weight.
    """
    own = stock.weight * area * across
    pressing, carrying = 0.0, []
    for hinge in design.hinges_by_patch[patch.id]:
        force = float(measured.forces[hinge.id] @ downward) * (1 if hinge.patches[0] == patch.id else -1)
        pressing += max(force, 0.0)
        if force < -CARRIES * own:
            carrying.append(hinge)
    span = 2 * _farthest(patch, carrying or design.hinges_by_patch[patch.id])
    bent = 5 * own / (384 * area) + pressing / (48 * area)
    return Sag(patch.id, bent * span**4 / stock.bending, span, pressing)


def _farthest(patch: Patch, hinges: Sequence[Hinge]) -> float:
    """Distance of that point of a patch that is farthest from all of some hinges, mm."""
    from shapely import distance, intersects, points
    from shapely.geometry import MultiLineString

    polygon = patch.plane.polygon(patch.points, patch.hole_points)
    low, high = np.reshape(polygon.bounds, (2, 2))
    grid = np.stack(np.meshgrid(*np.linspace(low, high, SAMPLES).T), axis=-1).reshape(-1, 2)
    places = points(np.concatenate([grid, patch.plane.flat(patch.points)]))
    lines = MultiLineString([patch.plane.flat(hinge.points) for hinge in hinges])
    return float((distance(lines, places) * intersects(polygon.buffer(ON_EDGE), places)).max())
