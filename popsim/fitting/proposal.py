"""A prism that might be placed, and what it would gain."""

from dataclasses import dataclass

from popsim.mechanisms import BasePatchPair, Primitive


@dataclass(frozen=True, eq=False)
class Prices:
    """What patches and columns cost, in solid cells.

    Attributes
    ----------
    patch:
        Price of a patch.
    trust:
        How much of what could later stand on a top counts when its height is chosen, 0..1.
    plain:
        Whether rows have one height.
    """

    patch: float
    trust: float = 0.0
    plain: bool = False


@dataclass(frozen=True, eq=False)
class Proposal:
    """A primitive on a base patch pair.

    Attributes
    ----------
    primitive:
        The primitive, card frame, mm.
    pair:
        Where it stands.
    gain:
        Cells gained, before any price.
    """

    primitive: Primitive
    pair: BasePatchPair
    gain: float
