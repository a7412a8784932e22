"""How long paper takes to cut, to crease and to glue, for somebody who does it for the first time."""

import numpy as np

from popsim.geometry.plane import path_length
from popsim.mechanisms.base import Mechanism
from popsim.mechanisms.company import plates_of

PER_METRE = 3.0
"""Minutes to cut one metre by knife or scissors."""

PER_CREASE = 0.25
"""Minutes to score a crease and to bend it."""

PER_JOINT = 1.0
"""Minutes to put glue onto a flap, to press it and to let it set."""


def minutes_of(mechanism: Mechanism) -> float:
    """Minutes for a mechanism before pieces are known: faces as they are cut, hinges as they are meant."""
    joints = mechanism.joints()
    rims = [np.concatenate([plate.outline, plate.outline[:1]]) for plate in plates_of(mechanism)]
    folded = [joint.axis for joint in joints if joint.kind == "fold"]
    cut = sum(map(path_length, rims)) - 2 * sum(map(path_length, folded))
    return PER_METRE * cut / 1000 + PER_CREASE * len(folded) + PER_JOINT * (len(joints) - len(folded))
