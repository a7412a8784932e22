"""Compile all functions of this folder, which spares it the first design: ``python -m popsim.fitting.kernels``."""

from itertools import product

import numpy as np

from popsim.design import Card
from popsim.fitting.appearance import Appearance
from popsim.fitting.field import Field, spot_on
from popsim.fitting.mapping import mappings
from popsim.fitting.mirror import lies_beyond
from popsim.fitting.proposal import Prices
from popsim.fitting.roofs import propose_roof
from popsim.fitting.rows import propose_row
from popsim.fitting.volume import measure_volume
from popsim.fitting.wishes import Wishes
from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Material, Surface
from popsim.mechanisms import RectangularPrism, card_pair
from popsim.rendering.ray_scene import RayScene

HALF = (
    ((-50.0, 0.0, 0.0), (50.0, 30.0, 40.0)),
    ((50.0, 27.0, 0.0), (66.0, 30.0, 40.0)),
    ((47.0, 30.0, 0.0), (50.0, 40.0, 40.0)),
)
"""Corners of three blocks: half of a body, and two fins that go on beyond one of its edges."""

SQUARES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Faces of a block, by its corners."""


def main() -> None:
    """Look at what is alike on both sides of the fold, and at one side that is shown deeper; propose prisms."""
    near = np.concatenate([_block(*corners) for corners in HALF])
    triangles = np.concatenate([near, near * [1.0, -1.0, 1.0]])
    count = len(triangles)
    surface = Surface(triangles, np.zeros((count, 3, 2)), np.zeros(count, int), (Material(np.ones(4)),))
    scene = RayScene(surface)
    seen = Appearance(scene, surface.bounds)
    pair = card_pair(Card(x=(-300.0, 300.0), depth=300.0))
    body = RectangularPrism((-50.0, -30.0, 0.0), (50.0, 30.0, 40.0))
    own = mappings(body, pair, "M1", Wishes().allows)[0].mechanism
    volume = measure_volume(scene, surface.bounds)
    spot = spot_on(Field(volume, 1.0), pair)
    assert spot is not None
    propose_roof(spot)
    propose_row(spot, Prices(0.1))
    seen.likeness([own])
    seen.likeness([own], {own.patch_id(plate.role): (2.0, 1.0) for plate in own.plates() if lies_beyond(plate)})


def _block(low: tuple[float, float, float], high: tuple[float, float, float]) -> FloatArray:
    """The triangles of a block, shape (12, 3, 3)."""
    corners = np.array(list(product(*zip(low, high, strict=True))))[np.array(SQUARES)]
    return np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])


main()
