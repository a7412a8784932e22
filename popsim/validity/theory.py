"""All conditions of a design, each with its margin in mm."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Design, MechanismRecord
from popsim.errors import DesignError, GeometryError
from popsim.geometry.arrays import FloatArray
from popsim.geometry.frame import OPEN, Side, page_poses
from popsim.mechanisms import Condition, Mechanism, Members, Recognition, mechanism_type
from popsim.validity.clear import clear_conditions
from popsim.validity.contained import contained_conditions
from popsim.validity.creases import crease_conditions
from popsim.validity.reach import OutlineReach


@dataclass(frozen=True, eq=False)
class Theory:
    """What the theory says of a design.

    Attributes
    ----------
    design:
        The design.
    recognised:
        What each mechanism was found to be, by its id.
    """

    design: Design
    recognised: Mapping[str, Recognition]

    @cached_property
    def mechanisms(self) -> dict[str, Mechanism]:
        """The mechanisms that have the shape of their type, by id."""
        return {name: found.mechanism for name, found in self.recognised.items() if found.mechanism is not None}

    @cached_property
    def roles(self) -> dict[str, tuple[str, str]]:
        """Mechanism and role of each recognised patch, by patch id."""
        return {
            patch: (name, role) for name in self.mechanisms for patch, role in self.recognised[name].roles.items()
        }

    @cached_property
    def conditions(self) -> tuple[Condition, ...]:
        """All conditions; empty where the design names no mechanisms, and then there is no theory to ask."""
        if not self.design.mechanisms:
            return ()
        own = [condition for found in self.recognised.values() for condition in found.conditions]
        creases = crease_conditions(self.design, {name: poses[HALF] for name, poses in self._reach.poses.items()})
        whole = [*clear_conditions(self.mechanisms, self._reach), *contained_conditions(self.design, self._reach)]
        return (*own, *_strangers(self.design), *creases, *whole)

    @property
    def holds(self) -> bool:
        """Whether all conditions hold."""
        return all(condition.holds for condition in self.conditions)

    @property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """Least and greatest x that the real outlines of each mechanism reach while closing, mm."""
        return {name: self._reach.own(name) for name in self.mechanisms}

    def poses(self, theta: FloatArray) -> dict[str, FloatArray]:
        """Closed-form motion of each recognised patch and the pages from the open pose, (n, 4, 4), by patch id."""
        theta = np.asarray(theta, float)
        found = {GROUND_ID: page_poses(Side.GROUND, theta), BACKDROP_ID: page_poses(Side.BACKDROP, theta)}
        by_role = {name: mechanism.poses(theta) for name, mechanism in self.mechanisms.items()}
        return found | {patch: by_role[name][role] for patch, (name, role) in self.roles.items()}

    @cached_property
    def _reach(self) -> OutlineReach:
        return OutlineReach(self.mechanisms, self.design, self.poses(SWEEP))


SWEEP = np.linspace(OPEN, 0.0, 61)
"""Fold angles at which reaches are taken: every 3 degrees, both ends included."""

HALF = len(SWEEP) // 2
"""Position of 90 degrees among them."""


def examine(design: Design) -> Theory:
    """Recognise the mechanisms of `design` from its patches and hinges, and state all conditions."""
    return Theory(design, {record.id: _recognise(design, record) for record in design.mechanisms})


def _recognise(design: Design, record: MechanismRecord) -> Recognition:
    members = Members(design, record)
    try:
        kind = mechanism_type(record.type)
        if members.pair.kind is not kind.pair_kind:
            expected = f"stands on {kind.pair_kind.value} pairs"
            return Recognition.unlike(
                record.id, f"a {record.type} {expected}, not on a {members.pair.kind.value} pair"
            )
        return kind.recognise(members)
    except (DesignError, GeometryError) as error:
        return Recognition.unlike(record.id, str(error))


def _strangers(design: Design) -> list[Condition]:
    """A broken condition for patches that belong to no mechanism: the theory does not speak of them."""
    alone = [patch.id for patch in design.popup_patches if patch.id not in design.owner]
    if not alone:
        return []
    return [Condition("foldable", ", ".join(alone), "belongs to a mechanism", -1.0)]
