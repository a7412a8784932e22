"""How places on parts answer to the joints of the tree that they hang on."""

from typing import Any

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray, cross


class Slopes:
    """The Jacobians of a MuJoCo model whose joints are all hinges.

    A place moves by the turn of each joint between its body and the root, about the axis where that is now; so all
    of it is told at once, without asking MuJoCo place by place.
    """

    def __init__(self, model: Any) -> None:
        above = np.zeros((model.nbody, model.nv), dtype=bool)
        for body in range(1, model.nbody):
            above[body] = above[model.body_parentid[body]]
            first = model.body_dofadr[body]
            if first >= 0:
                above[body, first : first + model.body_dofnum[body]] = True
        self._above = above

    def of(self, data: Any, bodies: IntArray, places: FloatArray) -> FloatArray:
        """How places (n, 3) in the world on bodies (n,) answer to the joints, per rad, shape (n, 3, v).

        `data` is MuJoCo's own, with bodies placed; lengths are in units of the model.
        """
        swept = cross(data.xaxis[None], places[:, None] - data.xanchor[None])
        return np.asarray(np.swapaxes(swept * self._above[bodies][..., None], 1, 2))
