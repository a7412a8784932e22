"""From a primitive to the mechanism that represents it best (Sec. 4.2, Table 1, Eq. 2).

Of those that represent it equally well the one that is easier to build goes first.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache

from popsim.mechanisms import MECHANISMS, BasePatchPair, Mechanism, Primitive, plates_of
from popsim.mechanisms.effort import minutes_of

EQUALLY = 0.01
"""Shares of the faces that differ by no more are the same to whoever looks at the pop-up."""


@dataclass(frozen=True)
class Mapped:
    """A mechanism for a primitive."""

    mechanism: Mechanism
    primitive: Primitive

    @cached_property
    def error_cover(self) -> float:
        """Eq. 2; asked for only where there is a choice."""
        return error_cover(self.mechanism, self.primitive)


def mappings(
    primitive: Primitive,
    pair: BasePatchPair,
    id: str,
    allows: Callable[[Mechanism], bool] = lambda mechanism: True,
) -> list[Mapped]:
    """All mechanisms that can and may represent `primitive` on `pair`, that with the least error_cover first.

    Where several have the least error_cover, by EQUALLY, that of them which takes least time to build is first.
    """
    return [mapped for mapped in _representing(primitive, pair, id) if allows(mapped.mechanism)]


@lru_cache(maxsize=4096)
def _representing(primitive: Primitive, pair: BasePatchPair, id: str) -> tuple[Mapped, ...]:
    """The same for all that can represent it."""
    found = [
        Mapped(mechanism, primitive)
        for kind in MECHANISMS.values()
        for mechanism in kind.from_primitive(primitive, pair, id)
    ]
    return easiest_first(found)


def easiest_first(found: Iterable[Mapped]) -> tuple[Mapped, ...]:
    """By error_cover; of those that come within EQUALLY of the least, what is built soonest first."""
    rest = list(found)
    if len(rest) > 1:
        rest.sort(key=lambda mapped: mapped.error_cover)
    ordered: list[Mapped] = []
    while rest:
        alike = rest[:1] + [other for other in rest[1:] if other.error_cover <= rest[0].error_cover + EQUALLY]
        ordered += sorted(alike, key=lambda mapped: minutes_of(mapped.mechanism)) if len(alike) > 1 else alike
        rest = rest[len(alike) :]
    return tuple(ordered)


def error_cover(mechanism: Mechanism, primitive: Primitive) -> float:
    """Eq. 2: the share of the primitive's faces that no principal face of the mechanism shows, 0..1."""
    shown = sum(plate.area for plate in plates_of(mechanism) if plate.principal)
    return max(0.0, 1.0 - shown / sum(primitive.face_areas()))
