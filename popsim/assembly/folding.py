"""Folding what is glued so far, by a run of its own in simulation."""

from functools import cached_property

import numpy as np

from popsim.assembly.evidence import Folded
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof
from popsim.design import Card, Design, Hinge, Patch
from popsim.geometry.arrays import FloatArray
from popsim.layout import Joint, Part
from popsim.simulation.partial import Crossings, Structure, fold_partial

OPENED, STEP = 178.0, 6.0
"""Degrees; the fold angle from which what is half made is folded, and the steps in which that is recorded. Fully
open many creases are flat, and could go either way: what was recorded there is left out."""

LATER = 0.5
"""Degrees by which the first angle may be wider."""


Point = tuple[float, float, float]


class Folding:
    """Parts of a layout, to be folded with the joints that were made."""

    def __init__(self, kit: Kit) -> None:
        self._kit = kit
        wanted = np.radians([*np.arange(OPENED, 0.0, -STEP), 0.0])
        frames = np.unique([kit.reference.frame(theta) for theta in wanted])
        self._frames = frames[np.degrees(kit.reference.theta[frames]) < OPENED + LATER]

    def folded(self, proof: Proof) -> Folded:
        """How what is there after a step folds by all joints that are made then."""
        made = {name for bundle in proof.apart for name in bundle.joints} | set(proof.joints)
        kit, parts, names = self._kit, proof.motion, {_hinge_id(joint) for joint in made}
        root = kit.ground(parts) or next(name for name in kit.layout.parts if name in parts)
        structure = self._whole.only(parts, names, root)
        poses = [kit.reference.poses[patch.id][self._frames] for patch in structure.design.patches]
        theta = kit.reference.theta[self._frames]
        found = fold_partial(structure, self._crossings, theta, np.stack(poses, axis=1))
        return Folded(len(parts), len(found.led), found.gap, found.thickness, found.crossing, found.crossed)

    @cached_property
    def _whole(self) -> Structure:
        layout = self._kit.layout
        seams = frozenset(_hinge_id(joint.id) for joint in layout.joints if joint.hinge is None)
        return Structure.of(self._design, seams, next(iter(layout.parts)))

    @cached_property
    def _crossings(self) -> Crossings:
        return Crossings(self._design)

    @cached_property
    def _design(self) -> Design:
        """Parts as patches and joints as hinges: where no patch is divided it is the design, line by line."""
        kit = self._kit
        return Design(
            card=Card(x=(-1.0, 1.0), depth=1.0),  # only patches and hinges are read
            patches=tuple(map(_patch, kit.layout.parts.values())),
            hinges=tuple(_hinge(joint, kit.ends[joint.id]) for joint in kit.layout.joints),
        )


def _patch(part: Part) -> Patch:
    if part.id == part.patch.id:
        return part.patch
    shape = part.polygon
    rings = [_points(part.plane.lift(np.array(ring.coords)[:-1])) for ring in (shape.exterior, *shape.interiors)]
    return Patch(id=part.id, outline=rings[0], holes=tuple(rings[1:]))


def _hinge(joint: Joint, ends: FloatArray) -> Hinge:
    kind, crease = ("glue", None) if joint.hinge is None else (joint.hinge.kind, joint.hinge.crease)
    first, last = _points(ends)
    return Hinge(id=_hinge_id(joint.id), patches=joint.parts, axis=(first, last), kind=kind, crease=crease)


def _hinge_id(joint: str) -> str:
    """Ids of seams have spaces, which those of hinges have not."""
    return joint.replace(" ", "_")


def _points(points: FloatArray) -> tuple[Point, ...]:
    return tuple((x, y, z) for x, y, z in points.tolist())
