"""An order that keeps the precedence and stays with what is in hand."""

from popsim.assembly.precedence import Precedence


def gluing_order(precedence: Precedence) -> tuple[str, ...]:
    """Ids of the glue joints in the order in which they are glued.

    Of the joints whose predecessors are done, that one comes next which joins the same two pieces as the last,
    else one at the same piece, else one in the same group, else the first of the design.
    """
    graph = precedence.graph
    waiting = {name: graph.in_degree(name) for name in graph}
    rank = {name: k for k, name in enumerate(precedence.joints)}
    order: list[str] = []
    while waiting:
        ready = [name for name, count in waiting.items() if count == 0]
        last = order[-1] if order else None
        chosen = min(ready, key=lambda name: (_distance(precedence, last, name), rank[name]))
        order.append(chosen)
        del waiting[chosen]
        for follower in graph.successors(chosen):
            waiting[follower] -= 1
    return tuple(order)


def _distance(precedence: Precedence, last: str | None, name: str) -> int:
    """How far `name` is from the joint glued last, 0 to 3."""
    if last is None:
        return 3
    before, now = precedence.ends[last], precedence.ends[name]
    if set(before) == set(now):
        return 0
    if set(precedence.stands(last)) == set(precedence.stands(name)):
        return 1
    return 2 if set(before) & set(now) else 3
