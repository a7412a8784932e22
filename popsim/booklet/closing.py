"""The last step: the card half closed, on its way, and closed."""

from dataclasses import replace

import numpy as np

from popsim.assembly import Scene, Step, flap_key
from popsim.assembly.flap_motion import flap_motions
from popsim.design import BACKDROP_ID, GROUND_ID
from popsim.geometry.arrays import FloatArray
from popsim.layout import Layout
from popsim.simulation import Sweep

HALF = 80.0
"""Degrees; the fold angle at which the card is shown on its way."""


def closing(step: Step, layout: Layout, sweep: Sweep) -> Step:
    """The step with scenes and motion as recorded; the ground stays on the table."""
    start = (sweep.closing_at([HALF]) or [sweep.closed])[0]
    ground = np.linalg.inv(sweep.poses[:, sweep.index[GROUND_ID]])
    poses = {name: ground @ sweep.poses[:, sweep.index[part.patch.id]] for name, part in layout.parts.items()}
    moving = {
        name: poses[name][start : sweep.closed + 1]
        for name, part in layout.parts.items()
        if part.patch.id == BACKDROP_ID
    }
    return replace(
        step,
        before=_scene({name: own[start] for name, own in poses.items()}, layout, sweep.theta[start]),
        after=_scene({name: own[sweep.closed] for name, own in poses.items()}, layout, 0.0),
        motion=moving,
    )


def _scene(poses: dict[str, FloatArray], layout: Layout, angle: float) -> Scene:
    """All flaps lie where they are glued."""
    flaps = {
        flap_key(motion.flap): poses[motion.flap.target] @ motion.landed
        for motion in flap_motions(layout).values()
    }
    return Scene(poses, flaps, angle)
