"""A fit at another size: everything is a length, so nothing need be searched again."""

from dataclasses import replace

from popsim.fitting.candidate import Node
from popsim.mechanisms import BasePatchPair, Primitive, PrismRow


def scaled_node(node: Node, factor: float) -> Node:
    """A node `factor` times as large."""
    return replace(node, primitive=scaled_primitive(node.primitive, factor), pair=_scaled_pair(node.pair, factor))


def scaled_primitive(primitive: Primitive, factor: float) -> Primitive:
    """A primitive `factor` times as large."""
    if isinstance(primitive, PrismRow):
        tops = tuple((x0 * factor, x1 * factor, height * factor) for x0, x1, height in primitive.tops)
        return PrismRow(primitive.half_width * factor, primitive.base * factor, tops)
    (x0, y0, z0), (x1, y1, z1) = primitive.low, primitive.high
    low, high = (x0 * factor, y0 * factor, z0 * factor), (x1 * factor, y1 * factor, z1 * factor)
    return replace(primitive, low=low, high=high)


def _scaled_pair(pair: BasePatchPair, factor: float) -> BasePatchPair:
    def both(ends: tuple[float, float]) -> tuple[float, float]:
        return ends[0] * factor, ends[1] * factor

    return replace(
        pair, u=pair.u * factor, v=pair.v * factor, x=both(pair.x), reach=both(pair.reach), free=both(pair.free)
    )
