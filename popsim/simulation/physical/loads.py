"""Weights and crease moments on the plates."""

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import OPEN
from popsim.geometry.rigid import transform
from popsim.simulation.physical.creases import Creases
from popsim.stock import Stock


def gravity(theta: FloatArray) -> FloatArray:
    """Direction of gravity in the card frame at fold angles (n,): straight into the ground, shape (n, 3)."""
    turn = (OPEN - np.asarray(theta, float)) / 2
    return np.stack([np.zeros_like(turn), np.sin(turn), -np.cos(turn)], axis=-1)


class Loads:
    """What pulls and turns the plates of a design made of some stock.

    Attributes
    ----------
    areas, centroids:
        Of each patch, holes left out: mm2, shape (p,); mm in the open pose, shape (p, 3).
    weights:
        N, shape (p,).
    springs:
        Stiffness of each hinge, N mm/rad, shape (h,).
    """

    def __init__(self, design: Design, stock: Stock) -> None:
        self.creases = Creases(design)
        flat = [patch.plane.polygon(patch.points, patch.hole_points) for patch in design.patches]
        self.areas: FloatArray = np.array([polygon.area for polygon in flat])
        self.centroids: FloatArray = np.array(
            [
                patch.plane.lift(np.array([polygon.centroid.x, polygon.centroid.y]))
                for patch, polygon in zip(design.patches, flat, strict=True)
            ]
        )
        self.weights: FloatArray = stock.weight * self.areas
        self.springs: FloatArray = stock.crease * self.creases.lengths

    def wrenches(self, poses: FloatArray, theta: FloatArray) -> FloatArray:
        """Weights and crease moments at fold angles (n,), in poses (n, p, 4, 4), shape (n, p, 6).

        Force in N and moment about the origin of the card frame in N mm on each patch.
        """
        total = self.of_weight(poses, theta)
        moments = -(self.springs * self.creases.bent(poses))[..., None] * self.creases.directions(poses)
        every = np.arange(len(poses))[:, None]
        np.add.at(total[..., 3:], (every, self.creases.second), moments)
        np.subtract.at(total[..., 3:], (every, self.creases.first), moments)
        return total

    def of_weight(self, poses: FloatArray, theta: FloatArray) -> FloatArray:
        """The same of the weights alone."""
        places = transform(poses, self.centroids[:, None])[:, :, 0]
        forces = self.weights[:, None] * gravity(theta)[:, None]
        return np.concatenate([forces, np.cross(places, forces)], axis=-1)

    def energy(self, poses: FloatArray, theta: FloatArray) -> FloatArray:
        """Energy of heights and creases at fold angles (n,), in poses (n, p, 4, 4), N mm, shape (n,)."""
        places = transform(poses, self.centroids[:, None])[:, :, 0]
        height = -(places * gravity(theta)[:, None]).sum(axis=-1)
        return np.asarray(height @ self.weights + self.creases.bent(poses) ** 2 @ self.springs / 2)
