"""Rows of pictures: model, pop-up at some fold angles, a sheet; one row for each view."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Design
from popsim.errors import InputError
from popsim.geometry.arrays import FloatArray, UInt8Array
from popsim.geometry.frame import OPEN
from popsim.geometry.surface import Surface
from popsim.pictures.look import Look
from popsim.pictures.photo import Shot, camera_for, photograph

if TYPE_CHECKING:
    from popsim.patches.popup_surface import Textures

RECORDED = 180
"""Fold angles recorded while closing, one per degree."""


AROUND = 0.08
"""How much of the pages is seen around the pop-up from near, of its size."""


def picture_strip(
    design: Design,
    textures: Path,
    angles: Sequence[float],
    *,
    looks: Sequence[Look] = (Look(),),
    model: Path | None = None,
    sheet: Path | None = None,
) -> UInt8Array:
    """Draw rows of pictures with captions, RGBA, shape (h, w, 4).

    Parameters
    ----------
    design:
        The design.
    textures:
        The folder its texture paths are relative to.
    angles:
        Fold angles of the pop-up, degrees, 180 open to 0 closed; the ground page lies on the table.
    looks:
        Views, at least one.
    model:
        The model it was made from; drawn first, where it stands on the card.
    sheet:
        A PDF; its first page is drawn last.

    Raises
    ------
    InputError
        An angle is out of range, or a file cannot be read, or the design does not say where its model stands.
    """
    from popsim.patches.popup_surface import popup_surface
    from popsim.rendering.contact_sheet import contact_sheet

    if any(not 0 <= angle <= 180 for angle in angles):
        raise InputError(f"fold angles lie between 0 (closed) and 180 (open) degrees, not {list(angles)}")
    surfaces = [
        _laid(popup_surface(design, textures, poses), angle)
        for angle, poses in zip(angles, _poses(design, angles), strict=True)
    ]
    solid = None if model is None else _model_surface(design, model)
    card = popup_surface(design, textures).bounds
    pictures, captions = [], []
    for look in looks:
        if solid is not None:
            pictures.append(photograph(solid, camera_for(card, look), look))
            captions.append("model")
        for angle, surface in zip(angles, surfaces, strict=True):
            pictures.append(photograph(surface, camera_for(surface.bounds, look), look))
            captions.append("open" if angle == 180 else f"{angle:g} degrees")
        if sheet is not None:
            pictures.append(_page(sheet, look))
            captions.append("sheet")
    return contact_sheet(pictures, captions, len(pictures) // len(looks))


def open_picture(design: Design, textures: "Textures", look: Look | None = None) -> UInt8Array:
    """Draw the open pop-up, RGBA, shape (h, w, 4).

    Raises
    ------
    InputError
        A texture is missing or no image.
    """
    return open_shot(design, textures, look).take()


def open_shot(design: Design, textures: "Textures", look: Look | None = None) -> Shot:
    """Set up a picture of the open pop-up; errors as of :func:`open_picture`."""
    from popsim.patches.popup_surface import popup_surface

    look = look or Look()
    surface = popup_surface(design, textures)
    return Shot.of(surface, camera_for(surface.bounds, look), look)


def beside(design: Design, textures: "Textures", solid: Surface, look: Look) -> UInt8Array:
    """Draw a model and its open pop-up from near, side by side, RGBA, shape (h, 2 w, 4).

    Parameters
    ----------
    solid:
        The model where it stands on the card.
    """
    from popsim.patches.popup_surface import popup_surface

    near, model = _near(design), solid.bounds
    camera = camera_for(np.array([np.minimum(near[0], model[0]), np.maximum(near[1], model[1])]), look)
    pair = [photograph(surface, camera, look) for surface in (solid, popup_surface(design, textures))]
    return np.concatenate(pair, axis=1)


def _near(design: Design) -> FloatArray:
    """Box around the open pop-up and a little of the pages, rows low and high, shape (2, 3)."""
    pages = np.concatenate([patch.points for patch in design.patches])
    corners = np.concatenate([patch.points for patch in (design.popup_patches or design.patches)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    reserve = AROUND * float((high - low).max())
    return np.array([np.maximum(low - reserve, pages.min(axis=0)), np.minimum(high + reserve, pages.max(axis=0))])


def _model_surface(design: Design, model: Path) -> Surface:
    """The model where it stands on the card.

    Raises
    ------
    InputError
        The design does not say where that is, or the file is no model.
    """
    from popsim.mesh.loading import load_model

    if design.model_to_card is None:
        raise InputError(
            "the design does not say where its model stands (model_to_card is null); leave the model out"
        )
    return load_model(model).surface.transformed(np.array(design.model_to_card))


def _laid(surface: Surface, angle: float) -> Surface:
    """A folded card turned about its fold until its ground page lies flat."""
    turn = (np.radians(angle) - OPEN) / 2
    motion = np.eye(4)
    motion[1:3, 1:3] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
    return surface.transformed(motion)


def _poses(design: Design, angles: Sequence[float]) -> list[dict[str, FloatArray] | None]:
    """Motion of each patch at each angle, (4, 4) by id, as simulated; None for the open pose."""
    if all(angle == 180 for angle in angles):
        return [None] * len(angles)
    from popsim.simulation.folding import fold_design

    sweep = fold_design(design, RECORDED).sweep
    found: list[dict[str, FloatArray] | None] = []
    for angle in angles:
        nearest = int(np.abs(sweep.degrees - angle).argmin())
        found.append({name: sweep.poses[nearest, index] for name, index in sweep.index.items()})
    return found


def _page(path: Path, look: Look) -> UInt8Array:
    """First page of a PDF as high as the other pictures, RGBA."""
    import pypdfium2

    try:
        document = pypdfium2.PdfDocument(path)
    except (OSError, pypdfium2.PdfiumError):
        raise InputError(f"{path} cannot be read as a PDF; give the sheets that popsim wrote") from None
    page = document[0]
    image = page.render(scale=look.height / page.get_height()).to_pil().convert("RGBA")
    return np.array(image, dtype=np.uint8)
