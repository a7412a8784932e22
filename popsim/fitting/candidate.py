"""A set of primitives on base patch pairs, and the mechanisms they stand for."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from popsim.design import Card
from popsim.errors import GeometryError
from popsim.fitting.knobs import knobs, settled, thinnest
from popsim.fitting.mapping import mappings
from popsim.fitting.wishes import Wishes
from popsim.mechanisms import BasePatchPair, Depths, Mechanism, Primitive, card_pair, plates_of
from popsim.validity import faces_clear


@dataclass(frozen=True)
class Node:
    """A primitive, the pair it stands on, and the node that offers the pair (None: the card).

    `kept` is its mechanism where the user keeps it as it is; else the primitive is mapped to one. `depths` are the
    factors on the depths of its plates (see :func:`popsim.mechanisms.plates_together`), by role.
    """

    primitive: Primitive
    pair: BasePatchPair
    parent: int | None
    kept: Mechanism | None = None
    depths: tuple[tuple[str, tuple[float, float]], ...] = ()


@dataclass(frozen=True)
class Candidate:
    """Nodes, bases before what stands on them, their mechanisms M1, M2 ..., the least extent in mm, and wishes."""

    card: Card
    nodes: tuple[Node, ...] = ()
    mechanisms: tuple[Mechanism, ...] = ()
    least: float = 0.0
    wishes: Wishes = field(default_factory=Wishes)

    @cached_property
    def patches(self) -> int:
        """Number of patches."""
        return sum(len(plates_of(mechanism)) for mechanism in self.mechanisms)

    @cached_property
    def pairs(self) -> list[tuple[BasePatchPair, int | None]]:
        """All pairs on offer, with the node that offers each."""
        offered: list[tuple[BasePatchPair, int | None]] = [(card_pair(self.card), None)]
        for index, mechanism in enumerate(self.mechanisms):
            offered += [(pair, index) for pair in mechanism.pairs()]
        return offered

    @cached_property
    def depths(self) -> Depths:
        """Factors on the depths of plates, by patch id."""
        both = zip(self.nodes, self.mechanisms, strict=True)
        return {own.patch_id(role): factors for node, own in both for role, factors in node.depths}

    def holds(self) -> bool:
        """Whether all conditions of the theory hold."""
        return faces_clear(self.mechanisms)

    def with_node(self, node: Node) -> "Candidate | None":
        """The candidate with one more node, or None where no mechanism can represent it."""
        return build(self.card, (*self.nodes, node), self.least, self.wishes)

    def with_primitive(self, index: int, primitive: Primitive) -> "Candidate | None":
        """The candidate with another primitive at a node, and all that stands on it moved along.

        None where no mechanism can represent it, or the node is kept.
        """
        if self.nodes[index].kept is not None:
            return None
        old = self.nodes[index]
        alike = len(knobs(primitive)) == len(knobs(old.primitive))
        changed = Node(primitive, old.pair, old.parent, depths=old.depths if alike else ())
        return build(self.card, (*self.nodes[:index], changed, *self.nodes[index + 1 :]), self.least, self.wishes)

    def with_depths(self, index: int, depths: Mapping[str, tuple[float, float]]) -> "Candidate":
        """The candidate with other factors on the depths of a node's plates, by role."""
        changed = replace(self.nodes[index], depths=tuple(sorted(depths.items())))
        return replace(self, nodes=(*self.nodes[:index], changed, *self.nodes[index + 1 :]))

    def without(self, index: int) -> "Candidate | None":
        """The candidate without a node and all that stands on it, or None where the node is kept."""
        if self.nodes[index].kept is not None:
            return None
        gone = {index}
        for later in range(index + 1, len(self.nodes)):
            if self.nodes[later].parent in gone:
                gone.add(later)
        kept = [k for k in range(len(self.nodes)) if k not in gone]
        place = {old: new for new, old in enumerate(kept)}
        nodes = [self.nodes[k] for k in kept]
        moved = [replace(n, parent=None if n.parent is None else place[n.parent]) for n in nodes]
        return build(self.card, moved, self.least, self.wishes)


def build(card: Card, nodes: Sequence[Node], least: float, wishes: Wishes | None = None) -> Candidate | None:
    """Build the mechanisms of nodes, each on the pair of its parent that is nearest to its own.

    None where a node finds no pair, is thinner than `least` mm, or no mechanism can or may represent it.
    """
    wishes = wishes or Wishes()
    done: list[Node] = []
    mechanisms: list[Mechanism] = []
    for index, node in enumerate(nodes):
        if node.kept is not None:
            done.append(node)
            mechanisms.append(node.kept)
            continue
        offered = [card_pair(card)] if node.parent is None else list(mechanisms[node.parent].pairs())
        pair = _nearest(node.pair, offered)
        if pair is None:
            return None
        try:
            primitive = settled(node.primitive, node.pair, pair)
        except GeometryError:
            return None
        if thinnest(primitive) < least:
            return None
        mapped = mappings(primitive, pair, f"M{index + 1}", wishes.allows)
        if not mapped:
            return None
        done.append(replace(node, primitive=primitive, pair=pair))
        mechanisms.append(mapped[0].mechanism)
    return Candidate(card, tuple(done), tuple(mechanisms), least, wishes)


def _nearest(pair: BasePatchPair, offered: Sequence[BasePatchPair]) -> BasePatchPair | None:
    """The pair of the same kind and side that lies nearest, or None."""
    alike = [other for other in offered if other.kind is pair.kind and other.side is pair.side]

    def distance(other: BasePatchPair) -> float:
        apart = max(0.0, max(pair.x[0], other.x[0]) - min(pair.x[1], other.x[1]))
        ends = abs(pair.x[0] - other.x[0]) + abs(pair.x[1] - other.x[1])
        return apart + abs(pair.u - other.u) + abs(pair.v - other.v) + 0.1 * ends

    return min(alike, key=distance, default=None)
