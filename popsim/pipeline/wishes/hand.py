"""What a wishes file asks of fitting, resolved: mechanisms on their base patch pairs, known types."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Card
from popsim.errors import DesignError, InputError
from popsim.fitting import Pin, Wishes
from popsim.mechanisms import MECHANISMS, BasePatchPair, Mechanism, card_pair
from popsim.mechanisms.restore import restored
from popsim.mesh.alignment import Side
from popsim.pipeline.wishes.model import FAR, Keep, WishesFile

PAGES = (GROUND_ID, BACKDROP_ID)


@dataclass(frozen=True)
class Hand:
    """What the user's hand has decided before a run.

    Attributes
    ----------
    wishes:
        For fitting.
    size:
        Longest side of the model, mm, that the wishes are stated at; None where they do not depend on it.
    fold:
        Side along which the fold runs where they were stated, or None.
    most_patches:
        Or None where nothing is said.
    sha256:
        Of the model that the file was written for, or None.
    """

    wishes: Wishes = field(default_factory=Wishes)
    size: float | None = None
    fold: Side | None = None
    most_patches: int | None = None
    sha256: str | None = None


def wishes_of(file: WishesFile) -> Wishes:
    """Resolve a file.

    Raises
    ------
    InputError
        A type is unknown, all are forbidden, or an entry cannot be a mechanism or has no such pair to stand on.
    """
    pins = tuple(Pin(known_type(pin.type, "pin"), pin.region.region()) for pin in file.pin)
    keep_out = tuple(box.region() for box in file.keep_out)
    return Wishes(_kept(file.keep), forbidden_types(file.forbid, "forbid"), keep_out, pins, add=file.add)


def known_type(name: str, option: str) -> str:
    """Return the name of a mechanism type; InputError naming the `option` for another word."""
    if name not in MECHANISMS:
        raise InputError(f"{option}: there is no mechanism '{name}'; expected one of {', '.join(MECHANISMS)}")
    return name


def forbidden_types(names: Iterable[str], option: str) -> frozenset[str]:
    """Return a set of mechanism types; InputError for unknown ones, and where none is left to use."""
    found = frozenset(known_type(name, option) for name in names)
    if found == set(MECHANISMS):
        raise InputError(f"{option}: all mechanisms are forbidden; allow at least one")
    return found


def _kept(entries: tuple[Keep, ...]) -> tuple[Mechanism, ...]:
    """The mechanisms of the entries, called M1, M2 ... in their order, as fitting does."""
    kept: list[Mechanism] = []
    names: dict[str, str] = {}
    for number, entry in enumerate(entries, 1):
        if entry.id in names:
            raise InputError(f"keep: two entries are called {entry.id}; give each its own id")
        try:
            mechanism = _standing(entry, f"M{number}", _offered(entry, kept, names))
        except (DesignError, InputError) as error:
            raise InputError(f"keep: {entry.id}: {str(error).removeprefix(f'M{number}: ')}") from None
        names[entry.id] = mechanism.id
        kept.append(mechanism)
    return tuple(kept)


def _offered(entry: Keep, kept: list[Mechanism], names: Mapping[str, str]) -> list[BasePatchPair]:
    """The pairs that the base of an entry may mean."""
    pairs = [card_pair(Card(x=(-FAR, FAR), depth=FAR)), *(pair for owner in kept for pair in owner.pairs())]
    base = tuple(_renamed(patch, names) for patch in entry.base)
    found = [pair for pair in pairs if pair.patches == base]
    if not found:
        known = ", ".join(f"[{', '.join(_written(patch, names) for patch in pair.patches)}]" for pair in pairs)
        raise InputError(
            f"nothing offers the base [{', '.join(entry.base)}]; the card and earlier entries offer {known}"
        )
    return found


def _renamed(patch: str, names: Mapping[str, str]) -> str:
    owner, dot, role = patch.partition(".")
    return f"{names.get(owner, owner)}{dot}{role}" if patch not in PAGES else patch


def _written(patch: str, names: Mapping[str, str]) -> str:
    owner, dot, role = patch.partition(".")
    return next((f"{old}{dot}{role}" for old, new in names.items() if new == owner), patch)


def _standing(entry: Keep, id: str, offered: list[BasePatchPair]) -> Mechanism:
    """The mechanism on the one of the offered pairs that it lies in, or nearest to."""
    made = [restored(entry.type, entry.parameters, pair, id) for pair in offered]

    def outside(mechanism: Mechanism) -> float:
        low, high = mechanism.face_box()[:, 0]
        return float(np.maximum(mechanism.pair.x[0] - low, 0.0) + np.maximum(high - mechanism.pair.x[1], 0.0))

    return min(made, key=outside)
