"""Applying a fault to the patches and hinges of a design."""

from typing import Any, TypeVar

import numpy as np

from popsim.design import Design, Hinge, Patch
from popsim.design.rules import check_rules, coplanar
from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Fault, Mechanism
from popsim.mechanisms.assemble import as_points

ON_LINE = 1e-6
"""mm; a corner nearer than this to the line moves with it."""

Piece = TypeVar("Piece", Patch, Hinge)


def spoil(design: Design, mechanism: Mechanism, fault: Fault, by: float) -> Design:
    """Shift the line of `fault` by `by` mm in the patches and hinges of `mechanism`.

    Raises
    ------
    DesignError
        The result breaks a rule of the format.
    """
    moving = {mechanism.patch_id(role) for role in fault.roles}
    touched = moving | set(mechanism.pair.patches)
    patches = {
        patch.id: _moved_patch(patch, fault, by) if patch.id in moving else patch for patch in design.patches
    }
    hinges = tuple(
        _moved_hinge(hinge, patches, fault, by)
        if moving.intersection(hinge.patches) and touched.issuperset(hinge.patches)
        else hinge
        for hinge in design.hinges
    )
    spoiled = design.model_copy(update={"patches": tuple(patches.values()), "hinges": hinges})
    fresh = Design(**{name: getattr(spoiled, name) for name in Design.model_fields})
    check_rules(fresh)
    return fresh


def _moved_patch(patch: Patch, fault: Fault, by: float) -> Patch:
    return _changed(patch, outline=as_points(_moved(patch.points, fault, by)))


def _moved_hinge(hinge: Hinge, patches: dict[str, Patch], fault: Fault, by: float) -> Hinge:
    first, second = as_points(_moved(hinge.points, fault, by))
    flat = coplanar(*(patches[name] for name in hinge.patches))
    return _changed(hinge, axis=(first, second), crease=hinge.crease if flat else None)


def _moved(points: FloatArray, fault: Fault, by: float) -> FloatArray:
    """Points (n, 3) with those on the line of the fault shifted."""
    start, end = fault.line
    length = float(np.linalg.norm(end - start))
    along = (points - start) @ (end - start) / length
    nearest = start + np.clip(along, 0.0, length)[:, None] * (end - start) / length
    on_line = np.linalg.norm(points - nearest, axis=1) < ON_LINE
    return np.asarray(points + on_line[:, None] * by * fault.shift)


def _changed(piece: Piece, **fields: Any) -> Piece:
    """A copy without what was derived from the old fields."""
    return type(piece)(**({name: getattr(piece, name) for name in type(piece).model_fields} | fields))
