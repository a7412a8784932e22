"""How far mechanisms and all that stands on them reach."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.design import Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform
from popsim.mechanisms import Mechanism


@dataclass(frozen=True, eq=False)
class Reach(ABC):
    """Reaches of mechanisms.

    Attributes
    ----------
    mechanisms:
        The mechanisms by id.
    """

    mechanisms: Mapping[str, Mechanism]

    @abstractmethod
    def own(self, name: str) -> tuple[float, float]:
        """Least and greatest x of a mechanism while closing, mm."""

    @abstractmethod
    def corners(self, name: str) -> FloatArray:
        """All corners of a mechanism's patches when open, shape (n, 3), mm."""

    @cached_property
    def subtrees(self) -> dict[str, tuple[str, ...]]:
        """Each mechanism and all that stands on it, directly or not, by id."""
        children: dict[str, list[str]] = {name: [] for name in self.mechanisms}
        for name, mechanism in self.mechanisms.items():
            owner = mechanism.pair.owner
            if owner in children and owner is not None:
                children[owner].append(name)

        def below(name: str) -> tuple[str, ...]:
            return (name, *(further for child in children[name] for further in below(child)))

        return {name: below(name) for name in self.mechanisms}

    def subtree(self, name: str) -> tuple[float, float]:
        """Least and greatest x of a mechanism and all that stands on it, mm."""
        ranges = [self.own(member) for member in self.subtrees[name]]
        return min(low for low, _ in ranges), max(high for _, high in ranges)

    def open_box(self, name: str) -> FloatArray:
        """Extent in skew coordinates (x, u, v) of a subtree when open, rows low and high, shape (2, 3), mm."""
        corners = np.concatenate([self.corners(member) for member in self.subtrees[name]])
        skew = np.abs(corners * [0, 1, 0]) + corners * [1, 0, 1]
        return np.array([skew.min(axis=0), skew.max(axis=0)])


@dataclass(frozen=True, eq=False)
class OutlineReach(Reach):
    """Reaches of the recognised mechanisms of a design, with the outlines they really have.

    Attributes
    ----------
    design:
        The design.
    poses:
        Motion of each recognised patch from the open pose to the closed one, (n, 4, 4), by patch id.
    """

    design: Design
    poses: Mapping[str, FloatArray]

    @cached_property
    def swept(self) -> dict[str, FloatArray]:
        """All corners of each mechanism's patches at each angle, (n, k, 3), by mechanism id."""
        return {
            name: np.concatenate(
                [
                    transform(self.poses[patch], self.design.patch_by_id[patch].points)
                    for patch in self.design.mechanism_by_id[name].patches
                ],
                axis=1,
            )
            for name in self.mechanisms
        }

    def own(self, name: str) -> tuple[float, float]:
        """Least and greatest x of a mechanism while closing, mm."""
        x = self.swept[name][..., 0]
        return float(x.min()), float(x.max())

    def corners(self, name: str) -> FloatArray:
        """All corners of a mechanism's patches when open, shape (n, 3), mm."""
        opened: FloatArray = self.swept[name][0]
        return opened


@dataclass(frozen=True, eq=False)
class FaceReach(Reach):
    """Reaches of mechanisms with plain faces, in closed form."""

    def own(self, name: str) -> tuple[float, float]:
        """Least and greatest x of a mechanism while closing, mm (Sec. 3.3.2)."""
        return self.mechanisms[name].closing_range()

    def corners(self, name: str) -> FloatArray:
        """All corners of the faces of a mechanism when open, shape (n, 3), mm."""
        return np.concatenate([plate.outline for plate in self.mechanisms[name].plates()])
