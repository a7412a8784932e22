"""From mechanisms to a design: pages, patches with ids, hinges."""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Card, Design, Hinge, MechanismRecord, Patch
from popsim.design.model import Point, TextureFrame
from popsim.design.rules import check_rules
from popsim.errors import DesignError
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import area_vector
from popsim.mechanisms.attach import held_stretches, lie_apart
from popsim.mechanisms.base import Mechanism
from popsim.mechanisms.company import plates_of
from popsim.mechanisms.plate import Plate

DECIMALS = 9
"""Coordinates are written to a picometre: beyond what matters, and the same on every machine."""


@dataclass(frozen=True, eq=False)
class Shape:
    """What a patch gets from the model instead of its plain face.

    Attributes
    ----------
    outline, holes:
        In the plane of the face, open pose, shapes (n, 3).
    texture:
        Path of the image, relative to the design file.
    texture_frame:
        Where the image lies.
    """

    outline: FloatArray
    holes: tuple[FloatArray, ...] = ()
    texture: str | None = None
    texture_frame: TextureFrame | None = None


def assemble(
    card: Card,
    mechanisms: Iterable[Mechanism],
    shapes: Mapping[str, Shape] | None = None,
    *,
    checked: bool = True,
    **extra: Any,
) -> Design:
    """Make a design of mechanisms.

    Parameters
    ----------
    card:
        The two pages.
    mechanisms:
        Each stands on the card or on a pair that another one offers.
    shapes:
        Contours and textures that replace the plain faces, by patch id ("G" and "B" too).
    checked:
        Check the rules of the format; a search that knows that its mechanisms fit can save the time.
    extra:
        Further fields of :class:`~popsim.design.Design`.

    Raises
    ------
    DesignError
        The result breaks a rule of the format, e.g. a mechanism stands beside its base patches, or the shapes of
        two patches leave nothing of a hinge between them.
    """
    shapes = shapes or {}
    parts = list(mechanisms)
    patches, hinges = _pages(card, shapes)
    for mechanism in parts:
        patches += [_patch(mechanism, plate, shapes) for plate in plates_of(mechanism)]
    hinges += _hinges(parts, {patch.id: patch for patch in patches}, shapes)
    records = tuple(_record(mechanism) for mechanism in parts)
    design = Design(card=card, patches=tuple(patches), hinges=tuple(hinges), mechanisms=records, **extra)
    if checked:
        check_rules(design)
    return design


def as_points(points: FloatArray) -> tuple[Point, ...]:
    """Rows of (n, 3) as the format writes them."""
    rounded = np.round(points, DECIMALS) + 0.0
    return tuple((float(x), float(y), float(z)) for x, y, z in rounded)


def page_outline(card: Card, sign: int) -> FloatArray:
    """Ground (sign 1) or backdrop (-1) in the open pose, counterclockwise from above, shape (4, 3)."""
    (x0, x1), depth = card.x, sign * card.depth
    ring = np.array([[x0, 0, 0], [x1, 0, 0], [x1, depth, 0], [x0, depth, 0]], float)
    return ring if sign > 0 else ring[::-1]


def _pages(card: Card, shapes: Mapping[str, Shape]) -> tuple[list[Patch], list[Hinge]]:
    patches = []
    for name, role, sign in ((GROUND_ID, "ground", 1), (BACKDROP_ID, "backdrop", -1)):
        shape = shapes.get(name, Shape(page_outline(card, sign)))
        patches.append(_shaped(name, None, role, shape))
    axis = as_points(np.array([[x, 0.0, 0.0] for x in card.x]))
    central = Hinge(
        id="h0", patches=(GROUND_ID, BACKDROP_ID), axis=(axis[0], axis[1]), kind="central", crease=(0.0, 0.0, -1.0)
    )
    return patches, [central]


def _patch(mechanism: Mechanism, plate: Plate, shapes: Mapping[str, Shape]) -> Patch:
    name = mechanism.patch_id(plate.role)
    outline = plate.outline if area_vector(plate.outline) @ plate.outward > 0 else plate.outline[::-1]
    return _shaped(name, mechanism.id, plate.role, shapes.get(name, Shape(outline)))


def _shaped(name: str, mechanism: str | None, role: str, shape: Shape) -> Patch:
    return Patch(
        id=name,
        mechanism=mechanism,
        role=role,
        outline=as_points(shape.outline),
        holes=tuple(as_points(hole) for hole in shape.holes),
        texture=shape.texture,
        texture_frame=shape.texture_frame,
    )


def _hinges(
    mechanisms: list[Mechanism], patches: Mapping[str, Patch], shapes: Mapping[str, Shape]
) -> Iterator[Hinge]:
    """All hinges but the central one; where contours leave gaps, several on one line (h7a, h7b, ...)."""
    joints = [(mechanism, joint) for mechanism in mechanisms for joint in mechanism.joints()]
    for number, (mechanism, joint) in enumerate(joints, 1):
        names = tuple(mechanism.patch_id(role) for role in joint.roles)
        if not shapes.keys() & set(names):
            yield _hinge(f"h{number}", names, joint.axis, joint.kind, joint.crease)
            continue
        first, second = (_known(name, patches, mechanism) for name in names)
        stretches = held_stretches(joint.axis, first, second)
        if not stretches:
            raise DesignError(
                f"hinges (h{number}): the outlines of {names[0]} and {names[1]} do not meet on their common line; "
                "let both reach it"
            )
        kind = joint.kind if lie_apart(joint.axis, first, second) else "glue"
        for letter, axis in zip(_letters(len(stretches)), stretches, strict=True):
            yield _hinge(f"h{number}{letter}", names, axis, kind, joint.crease)


def _known(name: str, patches: Mapping[str, Patch], mechanism: Mechanism) -> Patch:
    if name not in patches:
        raise DesignError(f"mechanisms ({mechanism.id}): it stands on {name!r}, which no mechanism here makes")
    return patches[name]


def _letters(count: int) -> list[str]:
    """Suffixes that keep several hinges on one line apart: none for a single one."""
    return [""] if count == 1 else [f"{'abcdefghijklmnopqrstuvwxyz'[k % 26]}{k // 26 or ''}" for k in range(count)]


def _hinge(
    name: str, patches: tuple[str, ...], axis: FloatArray, kind: Literal["fold", "glue"], crease: FloatArray | None
) -> Hinge:
    ends = as_points(axis)
    return Hinge(
        id=name,
        patches=(patches[0], patches[1]),
        axis=(ends[0], ends[1]),
        kind=kind,
        crease=None if crease is None else as_points(crease[None])[0],
    )


def _record(mechanism: Mechanism) -> MechanismRecord:
    low, high = mechanism.closing_range()
    return MechanismRecord(
        id=mechanism.id,
        type=mechanism.type,
        base=mechanism.pair.patches,
        patches=tuple(mechanism.patch_id(plate.role) for plate in plates_of(mechanism)),
        parameters=json.loads(json.dumps(mechanism.parameters())),
        closing_range=(float(low), float(high)),
    )
