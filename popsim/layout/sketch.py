"""What pieces would about be if patches were divided elsewhere: drawn from pieces that were planned in full."""

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.flat import common, inverse, move, move_shape
from popsim.layout.divisions import Division
from popsim.layout.joints import SHORTEST
from popsim.layout.laid import WELD, Planned

if TYPE_CHECKING:
    from shapely.geometry import Polygon
    from shapely.geometry.base import BaseGeometry


class Hanging(NamedTuple):
    """What hangs on a divided patch by a line, flat: its shape, or for a flap its depth, and the line (2, 2)."""

    shape: "BaseGeometry | float"
    line: FloatArray


class Sketch:
    """Shapes of pieces that were planned, and of those that other divisions of patches would make.

    Parameters
    ----------
    seam_depth:
        Of the flap along a seam, mm.
    too:
        Ids of patches that are whole as planned and shall be divided too.
    """

    def __init__(self, planned: Planned, seam_depth: float, too: Collection[str] = ()) -> None:
        self._parts, self._seam_depth, self._too = planned.parts, seam_depth, too
        self._kept: list[Polygon] = []
        self._hanging: dict[str, list[Hanging]] = {}
        for index, net in enumerate(planned.nets):
            divided = [name for name in net.motions if self._is_divided(name)]
            if not divided:
                self._kept.append(planned.pieces[index].outline)
            for name in divided:
                own = self._hanging.setdefault(self._parts[name].patch.id, [])
                own += _found(planned, index, name, divided)

    def shapes(self, divisions: Division) -> list["Polygon"]:
        """Shapes of all pieces where the patches that are divided are divided like this."""
        return [
            *self._kept,
            *(s for name, polygons in divisions.items() for s in self._divided(polygons, self._hanging[name])),
        ]

    def _is_divided(self, name: str) -> bool:
        return name in self._too or name != self._parts[name].patch.id

    def _divided(self, polygons: tuple["Polygon", ...], hanging: list[Hanging]) -> Iterator["Polygon"]:
        """The parts of one patch with the flaps of their seams and what hangs on each."""
        import shapely

        shapes: list[list[BaseGeometry]] = [[polygon] for polygon in polygons]
        for k, polygon in enumerate(polygons):
            for other in polygons[k + 1 :]:
                seam = common(polygon, other)
                if seam.length > SHORTEST:
                    shapes[k].append(seam.buffer(self._seam_depth, cap_style="flat"))
        for shape, ends in hanging:
            line = shapely.LineString(ends)
            if isinstance(shape, float):
                for own, polygon in zip(shapes, polygons, strict=True):
                    own.append(line.intersection(polygon.buffer(WELD)).buffer(shape, cap_style="flat"))
            else:
                distances = shapely.distance(np.array(polygons), line.centroid)
                shapes[int(np.argmin(distances))].append(shape.buffer(WELD))
        for own in shapes:
            whole = shapely.unary_union(own)
            yield max(shapely.get_parts(whole), key=lambda part: part.area)


def _found(planned: Planned, index: int, name: str, divided: list[str]) -> Iterator[Hanging]:
    """Flaps of one part of a divided patch, and what its folds hold, by the index of its net."""
    import networkx
    import shapely

    net, piece = planned.nets[index], planned.pieces[index]
    back = inverse(net.motions[name])
    for flap in piece.flaps:
        if flap.carrier == name and flap.joint.hinge is not None:
            depth = shapely.hausdorff_distance(flap.polygon, shapely.LineString(flap.line))
            yield Hanging(depth, flap.line)
    graph = networkx.Graph()
    graph.add_nodes_from(net.motions)
    graph.add_edges_from(fold.parts for fold in net.folds)
    graph.remove_nodes_from(divided)
    for fold in piece.folds:
        if fold.joint not in net.folds or name not in fold.joint.parts:
            continue
        beyond = fold.joint.other(name)
        if beyond in graph:
            members = networkx.node_connected_component(graph, beyond)
            yield Hanging(move_shape(back, planned.together(index, members)), move(back, fold.ends))
            graph.remove_nodes_from(members)
