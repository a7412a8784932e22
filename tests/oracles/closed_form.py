"""Poses of a whole design by the closed forms of its mechanisms, recognised from its patches."""

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import Side, page_poses
from popsim.mechanisms import MECHANISMS, Mechanism, Members


def recognised(design: Design) -> list[Mechanism]:
    """The mechanisms of a design, derived from patches and hinges; all must be recognised."""
    found = []
    for record in design.mechanisms:
        mechanism = MECHANISMS[record.type].recognise(Members(design, record)).mechanism
        assert mechanism is not None, record.id
        found.append(mechanism)
    return found


def closed_form_poses(design: Design, theta: FloatArray) -> dict[str, FloatArray]:
    """Motion from the open pose to fold angles theta (n,) of every patch, (n, 4, 4), by patch id."""
    theta = np.atleast_1d(np.asarray(theta, float))
    poses = {GROUND_ID: page_poses(Side.GROUND, theta), BACKDROP_ID: page_poses(Side.BACKDROP, theta)}
    for mechanism in recognised(design):
        for role, motion in mechanism.poses(theta).items():
            poses[mechanism.patch_id(role)] = motion
    return poses
