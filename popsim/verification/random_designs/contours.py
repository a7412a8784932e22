"""Random contours: notches and windows, the non-convex patches with holes that models give."""

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np
from numpy.random import Generator

from popsim.design import Design
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane, line_distance
from popsim.mechanisms import Mechanism, Plate, Shape
from popsim.mechanisms.assemble import as_points

CUT_SHARE = 0.4
"""How often a face on which nothing stands is cut."""

LEAST_AREA = 60.0
"""mm^2; smaller faces stay whole."""

MARGIN = 0.15
"""What is left around a window and beside a notch, of the square root of the area."""

ON_LINE = 1e-6
"""mm; an edge nearer than this to the line of a hinge carries it."""


def random_shapes(
    rng: Generator, mechanisms: Sequence[Mechanism], shaped: Collection[str] = ()
) -> dict[str, Shape]:
    """Shapes for some patches but those `shaped` before, by id.

    Hinges keep their whole length and nothing grows beyond its face.
    """
    bases = {*shaped, *(name for mechanism in mechanisms for name in mechanism.pair.patches)}
    shapes = {}
    for mechanism in mechanisms:
        for plate in mechanism.plates():
            name = mechanism.patch_id(plate.role)
            if name not in bases and rng.random() < CUT_SHARE:
                shapes[name] = _cut(rng, mechanism, plate)
    return shapes


def reshaped(design: Design, shapes: Mapping[str, Shape]) -> Design:
    """The design with the contours of :func:`random_shapes`, which leave all hinges as they are."""
    patches = tuple(
        patch.model_copy(
            update={
                "outline": as_points(shapes[patch.id].outline),
                "holes": tuple(as_points(hole) for hole in shapes[patch.id].holes),
            }
        )
        if patch.id in shapes
        else patch
        for patch in design.patches
    )
    return design.model_copy(update={"patches": patches})


def _cut(rng: Generator, mechanism: Mechanism, plate: Plate) -> Shape:
    plane = Plane.through(plate.outline)
    flat = plane.flat(plate.outline)
    area = plane.polygon(plate.outline).area
    if area < LEAST_AREA:
        return Shape(plate.outline)
    margin = float(MARGIN * np.sqrt(area))
    free = list(_free_edges(mechanism, plate))
    if free and rng.random() < 0.5:
        return Shape(plane.lift(_notched(flat, free[int(rng.integers(len(free)))], margin)))
    return Shape(plate.outline, tuple(plane.lift(hole) for hole in _window(flat, margin)))


def _free_edges(mechanism: Mechanism, plate: Plate) -> Iterator[int]:
    """Positions of the edges of a face along which no hinge runs."""
    axes = [joint.axis for joint in mechanism.joints() if plate.role in joint.roles]
    for position, (start, end) in enumerate(zip(plate.outline, np.roll(plate.outline, -1, axis=0), strict=True)):
        edge = np.array([start, end])
        if not any(line_distance(edge, axis).max() < ON_LINE for axis in axes):
            yield position


def _notched(flat: FloatArray, position: int, depth: float) -> FloatArray:
    """The ring with a triangle cut out of an edge, where that leaves a simple polygon around it."""
    from shapely import LineString, Polygon

    start, end = flat[position], flat[(position + 1) % len(flat)]
    inward = np.array([start[1] - end[1], end[0] - start[0]]) / np.linalg.norm(end - start)
    tip = (start + end) / 2 + depth * inward
    third, last = start + (end - start) / 3, end + (start - end) / 3
    ring = np.insert(flat, position + 1, [third, tip, last], axis=0)
    others = LineString(np.roll(flat, -position - 1, axis=0))
    whole = Polygon(ring).is_valid and others.distance(LineString([third, tip, last])) > depth / 4
    return ring if whole else flat


def _window(flat: FloatArray, margin: float) -> tuple[FloatArray, ...]:
    """The ring of a hole that keeps a margin, or nothing where there is no room for one."""
    from shapely import Polygon

    inner = Polygon(flat).buffer(-margin, join_style="mitre")
    if not isinstance(inner, Polygon) or inner.area < LEAST_AREA / 4:
        return ()
    return (np.array(inner.exterior.coords)[:-1],)
