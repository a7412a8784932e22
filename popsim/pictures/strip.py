"""A row of pictures: model, pop-up at some fold angles, a sheet."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Design
from popsim.errors import InputError
from popsim.geometry.arrays import FloatArray, UInt8Array
from popsim.geometry.surface import Surface

if TYPE_CHECKING:
    from popsim.patches.popup_surface import Textures
    from popsim.rendering.camera import Camera

RECORDED = 180
"""Fold angles recorded while closing, one per degree."""


@dataclass(frozen=True)
class Look:
    """How pictures are taken.

    Attributes
    ----------
    azimuth, elevation:
        Of the eye, degrees; azimuth 0 is the front (+x).
    width, height:
        Of each picture, pixels.
    """

    azimuth: float = 35.0
    elevation: float = 25.0
    width: int = 640
    height: int = 480

    def __post_init__(self) -> None:
        if not (-90 <= self.elevation <= 90):
            raise InputError(f"the elevation must lie between -90 and 90 degrees, not {self.elevation:g}")
        if not (16 <= self.width <= 8000 and 16 <= self.height <= 8000):
            raise InputError(f"pictures measure 16 to 8000 pixels, not {self.width} x {self.height}")


def picture_strip(
    design: Design,
    textures: Path,
    angles: Sequence[float],
    *,
    look: Look | None = None,
    model: Path | None = None,
    sheet: Path | None = None,
) -> UInt8Array:
    """Draw a row of pictures with captions, RGBA, shape (h, w, 4).

    Parameters
    ----------
    design:
        The design.
    textures:
        The folder its texture paths are relative to.
    angles:
        Fold angles of the pop-up, degrees, 180 open to 0 closed.
    look:
        View and size.
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
    from popsim.rendering.camera import Camera
    from popsim.rendering.contact_sheet import contact_sheet

    look = look or Look()
    if any(not 0 <= angle <= 180 for angle in angles):
        raise InputError(f"fold angles lie between 0 (closed) and 180 (open) degrees, not {list(angles)}")
    opened = popup_surface(design, textures)
    aspect = look.width / look.height
    camera = Camera.looking_at(_popup_box(design), look.azimuth, look.elevation, aspect=aspect)
    pictures, captions = [], []
    if model is not None:
        pictures.append(_picture(_model_surface(design, model), camera, look))
        captions.append("model")
    for angle, poses in zip(angles, _poses(design, angles), strict=True):
        surface = popup_surface(design, textures, poses) if poses else opened
        whole = Camera.looking_at(surface.bounds, look.azimuth, look.elevation, aspect=aspect)
        pictures.append(_picture(surface, camera if angle == 180 else whole, look))
        captions.append("open" if angle == 180 else f"{angle:g} degrees")
    if sheet is not None:
        pictures.append(_page(sheet, look))
        captions.append("sheet")
    return contact_sheet(pictures, captions, len(pictures))


def open_picture(design: Design, textures: "Textures", look: Look | None = None) -> UInt8Array:
    """Draw the open pop-up, RGBA, shape (h, w, 4).

    Raises
    ------
    InputError
        A texture is missing or no image.
    """
    from popsim.patches.popup_surface import popup_surface
    from popsim.rendering.camera import Camera

    look = look or Look()
    camera = Camera.looking_at(_popup_box(design), look.azimuth, look.elevation, aspect=look.width / look.height)
    return _picture(popup_surface(design, textures), camera, look)


def _popup_box(design: Design) -> FloatArray:
    """Box around all patches but the pages, a little larger."""
    corners = np.concatenate([patch.points for patch in (design.popup_patches or design.patches)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    reserve = 0.06 * float((high - low).max())
    return np.array([low - [reserve, reserve, 0], high + reserve])


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


def _model_surface(design: Design, model: Path) -> Surface:
    from popsim.mesh.loading import load_model

    if design.model_to_card is None:
        raise InputError(
            "the design does not say where its model stands (model_to_card is null); leave the model out"
        )
    return load_model(model).surface.transformed(np.array(design.model_to_card))


def _picture(surface: Surface, camera: "Camera", look: Look) -> UInt8Array:
    from popsim.rendering.picture import render_picture

    return render_picture(surface, camera, (look.width, look.height)).pixels


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
