"""How a joint lies in one of its parts: along an edge, or across the inside."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common, left_of
from popsim.layout.joints import Joint
from popsim.layout.parts import Part

BESIDE = 0.2
"""mm; how far beside a line paper is looked for: more than outlines deviate, less than any strip of paper."""


@dataclass(frozen=True, eq=False)
class Contact:
    """One stretch of a joint in the flat coordinates of a part.

    Attributes
    ----------
    ends:
        Ends, shape (2, 2), in the order of the stretch.
    left, right:
        Whether there is paper of the part to the left and to the right of the stretch.
    """

    ends: FloatArray
    left: bool
    right: bool

    @property
    def length(self) -> float:
        """Of the stretch, mm."""
        return float(np.linalg.norm(self.ends[1] - self.ends[0]))

    @property
    def is_edge(self) -> bool:
        """Whether the stretch bounds the part."""
        return self.left != self.right


@lru_cache(maxsize=4096)
def contacts(joint: Joint, part: Part) -> tuple[Contact, ...]:
    """The stretches of `joint` as `part` sees them."""
    return tuple(_contact(part, part.flat(stretch)) for stretch in joint.stretches)


def _contact(part: Part, ends: FloatArray) -> Contact:
    left, right = (_filled(part, line) for line in (ends, ends[::-1]))
    return Contact(ends, left, right)


def _filled(part: Part, line: FloatArray) -> bool:
    """Whether most of the strip to the left of `line` (2, 2) is paper."""
    from shapely.geometry import Polygon

    across = BESIDE * left_of(line)
    strip = Polygon([line[0], line[1], line[1] + across, line[0] + across])
    return bool(common(strip, part.polygon).area > strip.area / 2)
