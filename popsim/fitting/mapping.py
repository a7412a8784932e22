"""From a primitive to the mechanism that represents it best (Sec. 4.2, Table 1, Eq. 2).

Of those that represent it equally well the one that is easier to build goes first.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache

from popsim.mechanisms import MECHANISMS, BasePatchPair, Mechanism, Primitive, plates_of
from popsim.mechanisms.effort import minutes_of

EQUALLY = 0.01
"""Shares of the faces that differ by no more are the same to whoever looks at the pop-up."""


@dataclass(frozen=True)
class Mapped:
    """A mechanism for a primitive and its error."""

    mechanism: Mechanism
    error_cover: float


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
        Mapped(mechanism, error_cover(mechanism, primitive))
        for kind in MECHANISMS.values()
        for mechanism in kind.from_primitive(primitive, pair, id)
    ]
    return easiest_first(found)


def easiest_first(found: Iterable[Mapped]) -> tuple[Mapped, ...]:
    """By error_cover; of those that come within EQUALLY of the least, what is built soonest first."""
    rest = sorted(found, key=lambda mapped: mapped.error_cover)
    ordered: list[Mapped] = []
    while rest:
        alike = [mapped for mapped in rest if mapped.error_cover <= rest[0].error_cover + EQUALLY]
        ordered += sorted(alike, key=lambda mapped: minutes_of(mapped.mechanism)) if len(alike) > 1 else alike
        rest = rest[len(alike) :]
    return tuple(ordered)


def error_cover(mechanism: Mechanism, primitive: Primitive) -> float:
    """Eq. 2: the share of the primitive's faces that no principal face of the mechanism shows, 0..1."""
    shown = sum(plate.area for plate in plates_of(mechanism) if plate.principal)
    return max(0.0, 1.0 - shown / sum(primitive.face_areas()))
