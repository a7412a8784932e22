"""Placing prisms one after another, each where it gains most."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from popsim.design import Card
from popsim.errors import DesignError, GeometryError, InputError, MeshError
from popsim.fitting.corners import propose_corner
from popsim.fitting.field import Field, Spot, spot_on
from popsim.fitting.mapping import Mapped, mappings
from popsim.fitting.proposal import Prices, Proposal
from popsim.fitting.roofs import propose_roof
from popsim.fitting.rows import propose_row
from popsim.fitting.snap import Planes, snapped
from popsim.fitting.volume import Volume
from popsim.geometry.arrays import BoolArray
from popsim.mechanisms import BasePatchPair, Mechanism, PairKind, Primitive, assemble, card_pair
from popsim.validity import examine

DEAREST = 0.03
"""Price of a patch, as a share of the solid cells, at detail 0."""

CHEAPEST = 0.0008
"""The same at detail 1."""

BOTTOM = 0.25
"""Eq. 2 counts the face a prism stands on, which nobody sees: a box that shows all the rest has error_cover of
about 1/5. Shown shares are raised by this."""

SNAP = 1.2
"""Cells that a border may move to lie on a plane of the model."""


@dataclass(frozen=True)
class FitSettings:
    """What the user may say about fitting.

    Attributes
    ----------
    detail:
        0 (few patches) to 1 (many).
    most_patches:
        No prism is placed that would lead to more, ground and backdrop not counted.
    """

    detail: float = 0.5
    most_patches: int = 120

    def __post_init__(self) -> None:
        if not 0 <= self.detail <= 1:
            raise InputError(f"detail must lie between 0 (few patches) and 1 (many), not {self.detail:g}")
        if self.most_patches < 2:
            raise InputError(f"no pop-up has fewer than 2 patches; most patches is {self.most_patches}")

    @property
    def patch_price(self) -> float:
        """Price of a patch as a share of the solid cells."""
        return float(DEAREST * (CHEAPEST / DEAREST) ** self.detail)


@dataclass(frozen=True)
class Placement:
    """A primitive, the mechanism that represents it, and what else could have.

    Attributes
    ----------
    primitive, mechanism:
        The primitive and its mechanism.
    gain:
        Share of the solid cells gained.
    error_cover:
        Eq. 2.
    alternatives:
        Other mechanisms that could represent it: type and error_cover.
    """

    primitive: Primitive
    mechanism: Mechanism
    gain: float
    error_cover: float
    alternatives: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Fit:
    """The abstraction of a model.

    Attributes
    ----------
    placements:
        In the order they were placed: each stands on the card or on an earlier one.
    error_fit:
        Solid cells not covered plus empty cells covered, as a share of the solid cells.
    """

    placements: tuple[Placement, ...]
    error_fit: float

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """All mechanisms, bases before what stands on them."""
        return tuple(placement.mechanism for placement in self.placements)


def fit(volume: Volume, planes: Planes, settings: FitSettings | None = None) -> Fit:
    """Abstract a volume into prisms with their mechanisms.

    Parameters
    ----------
    volume:
        The model on the card, mm.
    planes:
        Where its surfaces lie, mm.
    settings:
        What the user wants.

    Raises
    ------
    MeshError
        No prism is worth a mechanism.
    """
    return _Fitter(volume, planes, settings or FitSettings()).run()


class _Fitter:
    """The greedy search; one instance serves one run."""

    def __init__(self, volume: Volume, planes: Planes, settings: FitSettings) -> None:
        self.volume, self.planes, self.settings = volume, planes, settings
        self.field = Field(volume)
        self.prices = Prices(settings.patch_price * self.field.solid_cells)
        far = 20 * volume.cell * max(volume.shape)
        self.card = Card(x=(-far, far), depth=far)
        self.pairs: list[BasePatchPair] = [card_pair(self.card)]
        self.placed: list[Placement] = []
        self.refused: set[tuple[BasePatchPair, str]] = set()

    def run(self) -> Fit:
        while (best := self._best()) is not None:
            self._place(*best)
        if not self.placed:
            raise MeshError("no part of the model is solid enough for a mechanism; try --detail 1 or another --up")
        return Fit(tuple(self.placed), self.field.error())

    def _best(self) -> tuple[Proposal, Mapped, list[Mapped]] | None:
        """The valid mechanism with the greatest profit, after what its principal faces leave unseen."""
        found = [(p, *self._mapped(p)) for p in self._proposals()]
        ranked = sorted(found, key=lambda entry: -self._profit(entry[0], entry[1]))
        for proposal, mapped, others in ranked:
            if mapped is None or self._profit(proposal, mapped) <= 0:
                return None
            if self._valid(mapped.mechanism):
                return proposal, mapped, others
            self.refused.add((proposal.pair, type(proposal.primitive).__name__))
        return None

    def _profit(self, proposal: Proposal, mapped: Mapped | None) -> float:
        """Gain as far as principal faces show it (Eq. 2), less the price of the patches; in cells."""
        if mapped is None:
            return -np.inf
        shown = min(1.0, (1 - mapped.error_cover) * (1 + BOTTOM))
        return proposal.gain * shown - self.prices.patch * len(mapped.mechanism.plates())

    def _proposals(self) -> Iterator[Proposal]:
        for pair in self.pairs:
            spot = spot_on(self.field, pair)
            if spot is None:
                continue
            for propose in self._kinds(spot):
                proposal = propose(spot, self.prices)
                if proposal is not None and (pair, type(proposal.primitive).__name__) not in self.refused:
                    yield proposal

    def _kinds(self, spot: Spot) -> tuple[Callable[[Spot, Prices], Proposal | None], ...]:
        """Searches for each kind of primitive that constraint 3 allows on a kind of pair."""
        if spot.pair.kind is PairKind.CORNER:
            return (propose_corner,)
        room = self._room(spot)
        return (lambda where, prices: propose_row(where, prices, room), propose_roof)

    def _room(self, spot: Spot) -> BoolArray:
        """Columns (x, w) where a row of each width keeps its closing range clear of its neighbours."""
        nx, nu, _ = spot.gain.shape
        centres = spot.start[0] + (np.arange(nx) + 0.5)[:, None] * spot.cell
        widths = (np.arange(nu) + 1)[None] * spot.cell
        low, high = spot.pair.free
        room = (centres - widths >= low) & (centres + widths <= high)
        for start, end in self._taken(spot.pair):
            room &= (centres - widths >= end) | (centres + widths <= start)
        return np.asarray(room)

    def _taken(self, pair: BasePatchPair) -> list[tuple[float, float]]:
        """Closing ranges of the mechanisms that already stand on a pair."""
        return [p.mechanism.closing_range() for p in self.placed if p.mechanism.pair.patches == pair.patches]

    def _mapped(self, proposal: Proposal) -> tuple[Mapped | None, list[Mapped]]:
        """The best mechanism for a proposal, and the others."""
        options = mappings(self._snapped(proposal), proposal.pair, f"M{len(self.placed) + 1}")
        return (options[0], options[1:]) if options else (None, [])

    def _snapped(self, proposal: Proposal) -> Primitive:
        try:
            return snapped(proposal.primitive, proposal.pair, self.planes, SNAP * self.volume.cell)
        except GeometryError:
            return proposal.primitive

    def _valid(self, mechanism: Mechanism) -> bool:
        """Whether the design still meets all conditions with one more mechanism."""
        mechanisms = [*(placement.mechanism for placement in self.placed), mechanism]
        if sum(len(m.plates()) for m in mechanisms) > self.settings.most_patches:
            return False
        try:
            return examine(assemble(self.card, mechanisms)).holds
        except DesignError:
            return False

    def _place(self, proposal: Proposal, mapped: Mapped, others: list[Mapped]) -> None:
        mechanism = mapped.mechanism
        primitive = self._snapped(proposal)
        share = proposal.gain / self.field.solid_cells
        alternatives = tuple((other.mechanism.type, other.error_cover) for other in others)
        self.placed.append(Placement(primitive, mechanism, share, mapped.error_cover, alternatives))
        self.field.cover(primitive)
        self.pairs += mechanism.pairs()
