"""Flaps as plates of the folding: each moves with what it is glued to, on the face that it is glued to."""

from collections.abc import Mapping

import numpy as np

from popsim.design import Design, Hinge, Patch
from popsim.geometry.arrays import FloatArray
from popsim.layout import Flap, Part
from popsim.simulation import Sweep


def with_flaps(parts: Mapping[str, Part], flaps: tuple[Flap, ...], sweep: Sweep, thickness: float) -> Sweep:
    """The motion of a design with the flaps of its layout as further patches, in their order.

    Parameters
    ----------
    parts:
        The parts of the layout, by id.
    sweep:
        Of the design that was laid out.
    thickness:
        Distance of a flap from the middle of its target, mm: it lies on its face.
    """
    names = [plate_id(flap) for flap in flaps]
    plates = [
        Patch(id=name, role="flap", outline=_outline(flap, parts[flap.target], thickness))
        for name, flap in zip(names, flaps, strict=True)
    ]
    hinges = [
        Hinge.model_validate(
            {
                "id": name,
                "patches": (parts[flap.target].patch.id, name),
                "axis": flap.joint.stretches[flap.stretch].tolist(),
                "kind": "glue",
            }
        )
        for name, flap in zip(names, flaps, strict=True)
    ]
    carried = [sweep.index[parts[flap.target].patch.id] for flap in flaps]
    design = Design(
        card=sweep.design.card,
        patches=(*sweep.design.patches, *plates),
        hinges=(*sweep.design.hinges, *hinges),
    )
    poses = np.concatenate([sweep.poses, sweep.poses[:, carried]], axis=1)
    return Sweep(design, sweep.theta, poses, sweep.states, sweep.complete)


def plate_id(flap: Flap) -> str:
    """Id of a flap among the patches; no patch of a design can have it that is a layout's."""
    return f"flap:{flap.joint.id.replace(' ', ':')}:{flap.stretch}"


def _outline(flap: Flap, target: Part, thickness: float) -> tuple[tuple[float, float, float], ...]:
    ring: FloatArray = np.array(flap.landing.exterior.coords)[:-1]
    lifted = target.plane.lift(ring) + flap.face.value * thickness * target.plane.normal
    return tuple((float(x), float(y), float(z)) for x, y, z in lifted)
