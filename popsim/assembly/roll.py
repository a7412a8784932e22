"""Sets of parts as bits of a number: taking apart asks thousands of times what hangs together."""

from collections.abc import Collection, Iterable, Iterator, Sequence


class Roll:
    """Names in a fixed order; the k-th is told by bit k of a mask."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = tuple(names)
        self._bits = {name: 1 << k for k, name in enumerate(self._names)}

    def mask(self, names: Collection[str]) -> int:
        """The mask of some names."""
        return sum(self._bits[name] for name in frozenset(names))

    def names(self, mask: int) -> frozenset[str]:
        """The names in a mask."""
        return frozenset(self._names[k] for k in places(mask))

    def relation(self, pairs: Iterable[tuple[str, str]]) -> list[int]:
        """For each name the mask of those that stand second in a pair with it."""
        found = [0] * len(self._names)
        for first, second in pairs:
            found[self._bits[first].bit_length() - 1] |= self._bits[second]
        return found


def places(mask: int) -> Iterator[int]:
    """The places of the bits that are set, the lowest first."""
    while mask:
        lowest = mask & -mask
        yield lowest.bit_length() - 1
        mask ^= lowest


def spread(seed: int, near: Sequence[int], among: int) -> int:
    """All that is reached from `seed` by going from each to what is `near` it, within `among`."""
    found, waiting = 0, seed & among
    while waiting:
        lowest = waiting & -waiting
        found |= lowest
        waiting = (waiting | near[lowest.bit_length() - 1] & among) & ~found
    return found


def groups(among: int, near: Sequence[int]) -> list[int]:
    """`among`, divided into what hangs together by `near`: the group with the lowest bit first."""
    found = []
    while among:
        group = spread(among & -among, near, among)
        found.append(group)
        among &= ~group
    return found
