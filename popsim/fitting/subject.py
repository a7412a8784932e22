"""What is to be abstracted."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from popsim.fitting.layers import Layers
from popsim.fitting.snap import Planes
from popsim.fitting.volume import Volume
from popsim.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene


@dataclass(frozen=True, eq=False)
class Subject:
    """A model that is to be abstracted.

    Attributes
    ----------
    scene:
        The model in the card frame, mm, without transparency.
    bounds:
        What counts of it, rows low and high, shape (2, 3).
    volume, planes:
        Its solid cells, and where its surfaces lie.
    points:
        Pseudo vertices within the bounds, evenly spread over its surface (Sec. 4.1), shape (n, 3).
    seed:
        Of what is drawn from them.
    """

    scene: "RayScene"
    bounds: FloatArray
    volume: Volume
    planes: Planes
    points: FloatArray
    seed: int = 0

    @cached_property
    def layers(self) -> Layers:
        """Where its views fall into layers (Eq. 3)."""
        from popsim.rendering.layers import Relief

        relief = Relief.of(self.scene, self.bounds)
        width = self.volume.cell
        return Layers.of(
            *(
                tuple(level.at for level in found)
                for found in (relief.tops(width), relief.ends(1, width), relief.ends(-1, width))
            )
        )
