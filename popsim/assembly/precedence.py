"""What must be glued before what (Sec. 4.4, [APH*03]), from patches, hinges and flaps alone.

Pieces held together behind their printed sides (flaps that close a box, a backbone under its top) make a *group*;
flaps that land on a printed side make one group *stand* on another, in the end on the card. Then

- what is shut in when a group is finished is glued before the joints that close the group;
- a group is finished before it is stood on anything;
- what stands on a group is glued to it while its underside is open: before the group itself is stood on something;
- the card is joined first, flat; what was divided is joined before all else;
- of two groups on one base, of which one stands on the other too, the lower is glued to the base first;
- of the flaps that stand one group on another, those of shut-in parts come first.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from typing import Any

from popsim.assembly.openness import HIDDEN, openness
from popsim.design import BACKDROP_ID, GROUND_ID
from popsim.layout import Face, Joint, Layout


@dataclass(frozen=True, eq=False)
class Precedence:
    """Glue joints of a layout with their groups.

    Attributes
    ----------
    layout:
        The layout that is assembled.
    """

    layout: Layout

    @cached_property
    def joints(self) -> dict[str, Joint]:
        """Glue joints by id, in the order of the layout."""
        glued = {flap.joint.id for flap in self.layout.flaps}
        return {joint.id: joint for joint in self.layout.joints if joint.id in glued}

    @cached_property
    def ends(self) -> dict[str, tuple[str, str]]:
        """Names of the two pieces at each glue joint: that which carries its (first) flap, that which takes it."""
        piece_of = self.layout.piece_of
        found: dict[str, tuple[str, str]] = {}
        for flap in self.layout.flaps:
            found.setdefault(flap.joint.id, (piece_of[flap.carrier].name, piece_of[flap.target].name))
        return found

    @cached_property
    def group_of(self) -> dict[str, int]:
        """Number of the group of each piece, by name; groups count in the order of the pieces."""
        import networkx

        graph = networkx.Graph()
        graph.add_nodes_from(piece.name for piece in self.layout.pieces)
        graph.add_edges_from(self.ends[name] for name in self.joints if name not in self.standing)
        card = [piece.name for piece in self.layout.pieces if self._is_card(piece.name)]
        graph.add_edges_from(pairwise(card))
        order = {name: k for k, name in enumerate(graph)}
        groups = sorted(networkx.connected_components(graph), key=lambda group: min(order[name] for name in group))
        return {name: k for k, group in enumerate(groups) for name in group}

    @cached_property
    def standing(self) -> frozenset[str]:
        """Ids of the joints at which one piece stands on the printed side of another."""
        return frozenset(
            flap.joint.id
            for flap in self.layout.flaps
            if flap.face is Face.PRINTED and not {flap.carrier, flap.target} <= self._card_parts
        )

    @cached_property
    def hidden(self) -> frozenset[str]:
        """Ids of the joints of parts that are shut in when all is finished."""
        seen = openness(self.layout.parts)
        return frozenset(
            name for name, joint in self.joints.items() if min(seen[part] for part in joint.parts) < HIDDEN
        )

    @cached_property
    def graph(self) -> Any:
        """Directed graph of joint ids: an edge leads from a joint to one that must wait for it."""
        import networkx

        graph = networkx.DiGraph()
        graph.add_nodes_from(self.joints)
        for before, after in self._edges():
            if before != after:
                graph.add_edge(before, after)
        # groups that lean on each other cannot wait for each other: within such a knot the order is free
        for knot in networkx.strongly_connected_components(graph):
            if len(knot) > 1:
                graph.remove_edges_from(
                    [edge for edge in product(sorted(knot), repeat=2) if graph.has_edge(*edge)]
                )
        return graph

    def stands(self, name: str) -> tuple[int, int]:
        """The group that stands at joint `name` and the group that it stands on."""
        carrier, target = self.ends[name]
        return self.group_of[carrier], self.group_of[target]

    @property
    def _card_parts(self) -> set[str]:
        return {name for name, part in self.layout.parts.items() if part.patch.id in (GROUND_ID, BACKDROP_ID)}

    def _is_card(self, piece: str) -> bool:
        return any(self.layout.piece_of[part].name == piece for part in self._card_parts)

    def _edges(self) -> Iterator[tuple[str, str]]:
        inner: dict[int, list[str]] = {}
        onto: dict[int, list[str]] = {}
        own: dict[int, list[str]] = {}
        for name in self.joints:
            upper, lower = self.stands(name)
            if name in self.standing and upper != lower:
                own.setdefault(upper, []).append(name)
                onto.setdefault(lower, []).append(name)
            else:
                inner.setdefault(upper, []).append(name)
        card = self._card_group
        for joints in inner.values():
            yield from self._hidden_first(joints)
            seams = [name for name in joints if self.joints[name].hinge is None]
            yield from product(seams, [name for name in joints if name not in seams])
        for group, joints in own.items():
            yield from product(inner.get(group, []), joints)
            yield from product(onto.get(group, []), joints)
            yield from self._hidden_first(joints)
        yield from product(inner.get(card, []), onto.get(card, []))
        yield from self._lower_first(own)

    @property
    def _card_group(self) -> int:
        return self.group_of[self.layout.piece_of[min(self._card_parts)].name]

    def _hidden_first(self, joints: list[str]) -> Iterator[tuple[str, str]]:
        first = [name for name in joints if name in self.hidden]
        yield from product(first, [name for name in joints if name not in self.hidden])

    def _lower_first(self, own: Mapping[int, list[str]]) -> Iterator[tuple[str, str]]:
        """Pairs of joints onto one base, of a group and of what stands on that group as well as on the base."""
        for joints in own.values():
            for near, far in product(joints, repeat=2):
                lower, base = self.stands(near)[1], self.stands(far)[1]
                if lower != base:
                    yield from ((name, far) for name in own.get(lower, []) if self.stands(name)[1] == base)
