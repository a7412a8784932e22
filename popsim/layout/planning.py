"""Nets and flaps together: a net that leaves no room for a flap is opened where it is in the way."""

from collections.abc import Mapping

from popsim.geometry.flat import common, left_of, move_shape
from popsim.layout.contact import BESIDE, Contact, contacts
from popsim.layout.errors import NoFlapError
from popsim.layout.flap import Flap
from popsim.layout.flap_shape import APART, SHORTEST_TAB
from popsim.layout.flaps import InTheWay, plan_flaps
from popsim.layout.joints import Joint
from popsim.layout.nets import Net, find_nets
from popsim.layout.parts import Part
from popsim.layout.settings import LayoutSettings

WIDE = SHORTEST_TAB
"""mm; where nothing lies right beyond a line, what hinders its flap lies as far away as the shallowest is deep."""

ROUNDS = 6
"""Times that nets are opened for flaps; each opening makes one more glue joint."""


def plan_pieces(
    listed: tuple[Part, ...],
    joints: tuple[Joint, ...],
    room: tuple[float, float],
    settings: LayoutSettings,
    in_the_way: InTheWay,
    barred: frozenset[str] = frozenset(),
) -> tuple[tuple[Net, ...], tuple[Flap, ...]]:
    """Return nets and the flaps of all joints that are no folds of them.

    `in_the_way` is asked where flaps would be in the way of anything that a layout does not know of; joints whose
    ids are `barred` become no folds.

    Raises
    ------
    NoFlapError
        A joint has room for a flap on neither side, whatever is opened.
    """
    parts = {part.id: part for part in listed}
    seams = any(joint.hinge is None for joint in joints)
    allowance = 2 * (settings.seam_depth if seams else settings.flap_depth)
    for _ in range(ROUNDS):
        nets = find_nets(listed, joints, room, allowance, barred, grain=settings.grain)
        flaps, left = plan_flaps(parts, joints, nets, settings, in_the_way)
        opened = next(filter(None, (_holding(left, parts, nets, reach) for reach in (BESIDE, WIDE))), None)
        if opened is None:
            break
        barred |= opened
    if left:
        raise NoFlapError(
            f"{left[0].id}: no flap fits between {left[0].parts[0]} and {left[0].parts[1]} on its "
            f"{left[0].length:.1f} mm; make the hinge longer (a larger size does), give the patches more room "
            "beside it, or let it lie on the edge of one of them",
            frozenset(parts[name].patch.id for name in left[0].parts),
        )
    return nets, flaps


def _holding(
    left: tuple[Joint, ...], parts: Mapping[str, Part], nets: tuple[Net, ...], reach: float
) -> frozenset[str]:
    """Ids of folds that hold other parts where flaps of these joints would be, `reach` mm from their lines."""
    import networkx

    found = set()
    for joint, name in [(one, part) for one in left for part in one.parts]:
        net = next(net for net in nets if name in net.motions)
        graph = networkx.Graph()
        for fold in net.folds:
            graph.add_edge(*fold.parts, fold=fold.id)
        for contact in contacts(joint, parts[name]):
            for other in _beyond(contact, name, parts, net, reach):
                path = networkx.shortest_path(graph, name, other)
                found.add(graph.edges[path[-2], path[-1]]["fold"])
    return frozenset(found)


def _beyond(contact: Contact, name: str, parts: Mapping[str, Part], net: Net, reach: float) -> list[str]:
    """Parts of a net in the way of a flap that goes `reach` mm beyond an edge of one of them."""
    from shapely.geometry import Polygon

    if not contact.is_edge:
        return []
    across = reach * left_of(contact.ends) * (-1 if contact.left else 1)
    strip = Polygon([*contact.ends, *(contact.ends[::-1] + across)])
    if reach > BESIDE:
        strip = strip.buffer(APART, join_style="mitre")
    moved = move_shape(net.motions[name], strip)
    return [
        other
        for other, motion in net.motions.items()
        if other != name and common(moved, move_shape(motion, parts[other].polygon)).area > 0.01 * moved.area
    ]
