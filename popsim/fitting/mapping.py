"""From a primitive to the mechanism that represents it best (Sec. 4.2, Table 1, Eq. 2)."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from popsim.geometry.plane import area_vector
from popsim.mechanisms import MECHANISMS, BasePatchPair, Mechanism, Primitive, plates_of


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
    """All mechanisms that can and may represent `primitive` on `pair`, that with the least error_cover first."""
    return [mapped for mapped in _representing(primitive, pair, id) if allows(mapped.mechanism)]


@lru_cache(maxsize=4096)
def _representing(primitive: Primitive, pair: BasePatchPair, id: str) -> tuple[Mapped, ...]:
    """All mechanisms that can represent a primitive, that with the least error_cover first."""
    found = [
        Mapped(mechanism, error_cover(mechanism, primitive))
        for kind in MECHANISMS.values()
        for mechanism in kind.from_primitive(primitive, pair, id)
    ]
    return tuple(sorted(found, key=lambda mapped: mapped.error_cover))


def error_cover(mechanism: Mechanism, primitive: Primitive) -> float:
    """Eq. 2: the share of the primitive's faces that no principal face of the mechanism shows, 0..1."""
    shown = sum(float(np.linalg.norm(area_vector(p.outline))) / 2 for p in plates_of(mechanism) if p.principal)
    return max(0.0, 1.0 - shown / sum(primitive.face_areas()))
