"""Colours of one trimesh geometry as popsim materials, texture coordinates and corner colours.

Works on trimesh objects without importing trimesh.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from popsim.geometry.arrays import FloatArray, UInt8Array
from popsim.geometry.surface import Material

PAPER_WHITE = np.ones(4)
"""Colour of a model that states none: nothing is printed."""

_MADE_UP = ((100, 100),) * 3 + ((255, 255),)
"""Lowest and highest RGBA of the 2 x 2 pixels that trimesh gives to texture coordinates without a material."""


@dataclass(frozen=True, eq=False)
class Look:
    """Colours of the `n` triangles of one geometry.

    Attributes
    ----------
    material:
        One material for all of them.
    uv:
        Texture coordinates per corner, shape (n, 3, 2).
    colours:
        RGBA per corner, 0..1, shape (n, 3, 4), or None.
    problem:
        Why the texture could not be used, or None.
    """

    material: Material
    uv: FloatArray
    colours: FloatArray | None
    problem: str | None = None


def look_of(visual: Any, faces: np.ndarray[Any, Any], *, linear: bool) -> Look:
    """Return the colours of a geometry.

    Parameters
    ----------
    visual:
        A trimesh `ColorVisuals` or `TextureVisuals`.
    faces:
        Vertex indices, shape (n, 3).
    linear:
        Whether factors and vertex colours are linear light; they are turned into display values (sRGB),
        which textures hold in every format.
    """
    material, problem = PAPER_WHITE, None
    texture = None
    source = getattr(visual, "material", None)
    if source is not None and not _made_up(source):
        is_pbr = hasattr(source, "baseColorFactor")
        material = _pbr_colour(source, linear) if is_pbr else _simple_colour(source)
        image = source.baseColorTexture if is_pbr else getattr(source, "image", None)
        texture, problem = _pixels(image)
        if texture is not None and _opaque(source):
            texture = texture.copy()
            texture[..., 3] = 255
    if texture is not None:
        texture.setflags(write=False)
    return Look(
        Material(material, texture), _corner_uv(visual, faces), _corner_colours(visual, faces, linear), problem
    )


def _made_up(source: Any) -> bool:
    """Whether a material is not of the file, but put there by trimesh: the file has texture coordinates only."""
    image = getattr(source, "image", None)
    if image is None or getattr(source, "kwargs", {}) or image.format is not None:  # `format`: read from a file
        return False
    return bool(image.size == (2, 2) and image.getextrema() == _MADE_UP)


def _opaque(source: Any) -> bool:
    """Whether the format says that the alpha of a texture means nothing: glTF OPAQUE, MTL without map_d."""
    if hasattr(source, "baseColorFactor"):
        return source.alphaMode in (None, "OPAQUE")
    return "map_d" not in getattr(source, "kwargs", {})


def srgb(linear: FloatArray) -> FloatArray:
    """Return display values (IEC 61966-2-1) of linear light, both 0..1; alpha (4th channel) is kept."""
    encoded = np.where(
        linear <= 0.0031308, linear * 12.92, 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    )
    if linear.shape[-1] == 4:
        encoded[..., 3] = linear[..., 3]
    return encoded


def _pbr_colour(source: Any, linear: bool) -> FloatArray:
    factor = source.baseColorFactor
    colour = PAPER_WHITE.copy() if factor is None else _rgba(np.asarray(factor))
    if source.alphaMode in (None, "OPAQUE") or colour[3] == 0:
        colour[3] = 1.0  # glTF 2.0, 3.9.6: alpha is ignored; and nobody means 0, which some exporters write
    return srgb(colour) if linear else colour


def _simple_colour(source: Any) -> FloatArray:
    """Kd and d of an MTL material.

    A grey Kd beside a texture says how much light the surface returns, which exporters fill with 0.4 or 0.8
    by default; it would only dim the print, so it counts as white. A coloured one tints the texture.
    """
    stated = "kd" in getattr(source, "kwargs", {})  # else trimesh's own dark grey stands in `diffuse`
    colour = _rgba(np.asarray(source.diffuse)) if stated else PAPER_WHITE.copy()
    if getattr(source, "image", None) is not None and np.ptp(colour[:3]) < 1 / 255:
        colour[:3] = 1.0
    colour[3] = _dissolve(getattr(source, "kwargs", {}).get("d"))
    return colour


def _dissolve(words: Any) -> float:
    """`d` of an MTL material; nobody means 0 (invisible), and `Tr` has two opposite customs: both count as 1."""
    try:
        value = float(words[-1])
    except (TypeError, ValueError, IndexError):
        return 1.0
    return value if 0.0 < value <= 1.0 else 1.0


def _rgba(values: np.ndarray[Any, Any]) -> FloatArray:
    """Bring RGB or RGBA of any number type to float64 RGBA in 0..1, keeping leading axes."""
    if np.issubdtype(values.dtype, np.integer):
        scaled = values / float(np.iinfo(values.dtype).max)
    else:
        scaled = values.astype(np.float64)
    if scaled.shape[-1] == 3:
        scaled = np.concatenate([scaled, np.ones((*scaled.shape[:-1], 1))], axis=-1)
    return np.clip(np.nan_to_num(scaled), 0.0, 1.0)


def _pixels(image: Any) -> tuple[UInt8Array | None, str | None]:
    if image is None:
        return None, None
    try:
        return np.array(image.convert("RGBA"), dtype=np.uint8), None
    except (OSError, ValueError, SyntaxError) as error:  # what Pillow raises for damaged image data
        return None, f"a texture cannot be decoded ({str(error).splitlines()[0]}); the material's colour is used"


def _corner_uv(visual: Any, faces: np.ndarray[Any, Any]) -> FloatArray:
    uv = getattr(visual, "uv", None)
    if uv is None or np.ndim(uv) != 2 or np.shape(uv)[1] < 2 or (len(faces) and len(uv) <= faces.max()):
        return np.zeros((len(faces), 3, 2))
    corners: FloatArray = np.nan_to_num(np.asarray(uv, dtype=np.float64)[:, :2])[faces]
    return corners


def _corner_colours(visual: Any, faces: np.ndarray[Any, Any], linear: bool) -> FloatArray | None:
    per_face, values = False, None
    if getattr(visual, "kind", None) in ("vertex", "face"):
        per_face = visual.kind == "face"
        values = visual.face_colors if per_face else visual.vertex_colors
    elif hasattr(visual, "vertex_attributes"):
        values = visual.vertex_attributes.get("color")
    if values is None or np.ndim(values) != 2 or np.shape(values)[1] not in (3, 4):
        return None
    if len(values) <= (len(faces) - 1 if per_face else faces.max()):
        return None
    colours = _rgba(np.asarray(values))
    colours = srgb(colours) if linear else colours
    return np.repeat(colours[: len(faces), None], 3, axis=1) if per_face else colours[faces]
