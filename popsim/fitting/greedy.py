"""Placing prisms one after another, each where it gains most of the volume."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from popsim.errors import GeometryError
from popsim.fitting.candidate import Candidate, Node
from popsim.fitting.corners import propose_corner
from popsim.fitting.field import Field, Spot, spot_on
from popsim.fitting.knobs import simplified
from popsim.fitting.layers import Layers
from popsim.fitting.mapping import Mapped, mappings
from popsim.fitting.proposal import Prices, Proposal
from popsim.fitting.roofs import propose_roof
from popsim.fitting.rows import propose_row
from popsim.fitting.snap import Planes, snapped
from popsim.fitting.volume import Volume
from popsim.fitting.wedges import propose_wedges
from popsim.geometry.arrays import BoolArray
from popsim.mechanisms import BasePatchPair, PairKind, Primitive, plates_of

SNAP = 1.2
"""Cells that a border may move to lie on a plane of the model."""

BOTTOM = 0.25
"""Eq. 2 counts the face a prism stands on, which nobody sees: a box that shows all the rest has error_cover of
about 1/5. Shown shares are raised by this."""


@dataclass(frozen=True)
class Taste:
    """What a greedy run values.

    Attributes
    ----------
    price:
        Price of a patch, as a share of the solid cells.
    empty:
        Price of covering an empty cell, in solid cells; below 1, contours cut some of it away again.
    trust:
        How much of what could later stand on a top counts when its height is chosen, 0..1.
    most_patches:
        No prism is placed that would lead to more.
    founded:
        Whether the first prism must carry others: roofs and wedges gain much at once, and end it there.
    plain:
        Whether there are only boxes of one height: tiers on tiers instead of profiles and roofs.
    layers:
        Where rows may have their steps and tops; None for everywhere.
    """

    price: float
    empty: float
    trust: float
    most_patches: int
    founded: bool = False
    plain: bool = False
    layers: Layers | None = None


class Grower:
    """Places prisms on a volume to one taste."""

    def __init__(self, volume: Volume, planes: Planes, taste: Taste) -> None:
        self.volume, self.planes, self.taste = volume, planes, taste
        self.known: dict[BasePatchPair, tuple[bytes, list[Proposal]]] = {}

    def grow(self, state: Candidate) -> Candidate:
        """Place prisms until none is worth its patches."""
        refused: set[tuple[BasePatchPair, type]] = set()
        while (best := self._best(state, refused)) is not None:
            state = best
        return state

    def additions(self, state: Candidate) -> Iterator[Candidate]:
        """The state with one more prism, the most profitable first; not all of them need be valid."""
        for _, node in self._ranked(state):
            grown = state.with_node(node)
            if grown is not None and self._allowed(grown):
                yield grown

    def _best(self, state: Candidate, refused: set[tuple[BasePatchPair, type]]) -> Candidate | None:
        """The state with the most profitable prism that keeps it valid."""
        for profit, node in self._ranked(state):
            if profit <= 0:
                return None
            if (node.pair, type(node.primitive)) in refused:
                continue
            grown = state.with_node(node)
            if grown is not None and self._allowed(grown) and grown.holds():
                return grown
            refused.add((node.pair, type(node.primitive)))
        return None

    def _allowed(self, state: Candidate) -> bool:
        """Whether a state is to this taste."""
        rests = not self.taste.founded or bool(state.mechanisms[0].pairs())
        return rests and state.patches <= self.taste.most_patches

    def _ranked(self, state: Candidate) -> list[tuple[float, Node]]:
        """All prisms that could be placed next with their profits in cells, the best first."""
        field = Field(self.volume, self.taste.empty)
        for node in state.nodes:
            field.cover(node.primitive)
        for region in state.wishes.keep_out:
            field.bar(region.bounds)
        price = self.taste.price * field.solid_cells
        options = []
        for pair, parent in state.pairs:
            for proposal in self._proposals(field, state, pair, Prices(price, self.taste.trust, self.taste.plain)):
                primitive = simplified(self._snapped(proposal), state.least)
                mapped = mappings(primitive, pair, "M", state.wishes.allows)
                if mapped:
                    options.append((_profit(proposal, mapped[0], price), Node(primitive, pair, parent)))
        return sorted(options, key=lambda option: -option[0])

    def _proposals(self, field: Field, state: Candidate, pair: BasePatchPair, prices: Prices) -> list[Proposal]:
        """The best primitive of each kind that constraint 3 allows on a pair."""
        spot = spot_on(field, pair)
        if spot is None:
            return []
        room = _room(spot, state) if pair.kind is PairKind.OPENING else None
        seen = spot.gain.tobytes() + (b"" if room is None else room.tobytes())
        known = self.known.get(pair)
        if known is None or known[0] != seen:
            found: list[Proposal | None]
            if room is None:
                found = [propose_corner(spot)]
            else:
                layers = self.taste.layers
                found = [propose_row(spot, prices, room, None if layers is None else layers.allowed(spot))]
                if not self.taste.plain:
                    found += [propose_roof(spot), *propose_wedges(spot)]
            known = (seen, [proposal for proposal in found if proposal is not None])
            self.known[pair] = known
        return known[1]

    def _snapped(self, proposal: Proposal) -> Primitive:
        try:
            return snapped(proposal.primitive, proposal.pair, self.planes, SNAP * self.volume.cell)
        except GeometryError:
            return proposal.primitive


def _room(spot: Spot, state: Candidate) -> BoolArray:
    """Columns (x, w) where a row of each width keeps its closing range clear of its neighbours."""
    nx, nu, _ = spot.gain.shape
    centres = spot.start[0] + (np.arange(nx) + 0.5)[:, None] * spot.cell
    widths = (np.arange(nu) + 1)[None] * spot.cell
    low, high = spot.pair.free
    room = (centres - widths >= low) & (centres + widths <= high)
    for mechanism in state.mechanisms:
        if mechanism.pair.patches == spot.pair.patches:
            start, end = mechanism.closing_range()
            room &= (centres - widths >= end) | (centres + widths <= start)
    return np.asarray(room)


def _profit(proposal: Proposal, mapped: Mapped, price: float) -> float:
    """Gain as far as principal faces show it (Eq. 2), less the price of the patches; in cells."""
    shown = min(1.0, (1 - mapped.error_cover) * (1 + BOTTOM))
    return proposal.gain * shown - price * len(plates_of(mapped.mechanism))
