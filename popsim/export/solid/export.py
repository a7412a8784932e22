"""Exporting a design in space, folded in simulation."""

import shutil
import tempfile
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np

from popsim.design import Design
from popsim.errors import InputError
from popsim.export.solid.glb import write_glb
from popsim.export.solid.obj import write_obj
from popsim.export.solid.scene import Scene, leaves_of
from popsim.export.solid.stl import write_stl
from popsim.files import refuse_overwrite, write_file
from popsim.geometry.arrays import FloatArray

OPEN = 180.0
"""Degrees; fold angle of the open card."""

FRAMES = 60
"""Recorded fold angles each way of an animation."""

FINEST = 720
"""Most fold angles that are recorded to meet one: a quarter of a degree apart."""

SolidWriter = Callable[[Scene, Path], tuple[Path, ...]]

SOLIDS: dict[str, SolidWriter] = {"glb": write_glb, "obj": write_obj, "stl": write_stl}
"""Writers by the name of their format; those of MOVING ones show all fold angles unless one is asked for."""

MOVING = frozenset({"glb"})


def export_solid(
    design: Design, path: Path, format: str, *, textures: Path, angle: float | None = None, force: bool = False
) -> tuple[Path, ...]:
    """Write a design in space; the same input gives the same bytes.

    Parameters
    ----------
    path:
        The file; what belongs to it (materials, pictures) is put beside it.
    format:
        A name in :data:`SOLIDS`.
    textures:
        The folder that the textures' paths are relative to: that of the design file.
    angle:
        Fold angle in degrees, 180 open to 0 closed. None for the whole folding where the format can move, else for
        the open pose.
    force:
        Overwrite existing files.

    Returns
    -------
    The files written.

    Raises
    ------
    InputError
        The format is unknown, the angle out of range, the design is torn, or a texture cannot be read.
    OutputError
        A file exists, or the folder cannot be written.
    """
    if format not in SOLIDS:
        raise InputError(f"format {format!r} is not known; give {', '.join(SOLIDS)}")
    if angle is not None and not 0 <= angle <= OPEN:
        raise InputError(f"the fold angle lies between 0 (closed) and 180 (open) degrees, not {angle:g}")
    refuse_overwrite(path, force)
    if angle is None and format in MOVING:
        degrees, poses = _sweep_poses(design, FRAMES)
    else:
        degrees, poses = _at(design, OPEN if angle is None else angle)
    scene = Scene(leaves_of(design, textures), degrees, poses, textures)
    with tempfile.TemporaryDirectory() as folder:
        made = SOLIDS[format](scene, Path(folder) / path.name)
        targets = [path.with_name(file.name) for file in made]
        for target in targets:
            refuse_overwrite(target, force)
        for file, target in zip(made, targets, strict=True):
            write_file(target, partial(shutil.copyfile, file), force=force)
    return tuple(targets)


def _at(design: Design, angle: float) -> tuple[FloatArray, FloatArray]:
    """One fold angle in degrees (1,), and poses of all patches there (1, p, 4, 4)."""
    if angle == OPEN:
        return np.array([OPEN]), np.tile(np.eye(4), (1, len(design.patches), 1, 1))
    share = Fraction(1 - angle / OPEN).limit_denominator(FINEST)
    degrees, poses = _sweep_poses(design, share.denominator * max(1, FRAMES // share.denominator))
    nearest = int(np.abs(degrees - angle).argmin())
    return degrees[nearest : nearest + 1], poses[nearest : nearest + 1]


def _sweep_poses(design: Design, count: int) -> tuple[FloatArray, FloatArray]:
    """Fold angles in degrees (n,) and poses (n, p, 4, 4) with so many angles each way.

    Raises
    ------
    InputError
        The card does not close.
    """
    from popsim.simulation import fold_design

    sweep = fold_design(design, count).sweep
    if not sweep.complete:
        raise InputError("the design is torn apart while it closes; run popsim verify to see where")
    return sweep.degrees, sweep.poses
