"""The pop-up as a coloured surface, for pictures: prints on the seen side, bare paper on the other."""

from collections.abc import Mapping
from io import BytesIO
from pathlib import Path

import numpy as np

from popsim.design import BACKDROP_ID, GROUND_ID, Design, Patch
from popsim.errors import InputError
from popsim.files import read_bytes
from popsim.geometry.arrays import FloatArray, UInt8Array
from popsim.geometry.rigid import transform
from popsim.geometry.surface import Material, Surface

PAPER = Material(np.array([0.95, 0.94, 0.92, 1.0]))
"""Paper without a print, and its reverse where the card does not say otherwise."""

PAGE = Material(np.array([0.80, 0.84, 0.80, 1.0]))
"""Ground and backdrop without a print: darker, so that white models stand out."""

REVERSE = 2
"""Index of the material of what is not printed."""

Textures = Path | Mapping[str, bytes]


def popup_surface(
    design: Design, textures: Textures, poses: Mapping[str, FloatArray] | None = None, *, pages: bool = True
) -> Surface:
    """Return the pop-up as a surface in the card frame, mm.

    Parameters
    ----------
    design:
        The design.
    textures:
        Folder of the design file, or PNG bytes by the paths that the patches name.
    poses:
        Motion of each patch from the open pose, shape (4, 4), by patch id; None for the open pose.
    pages:
        Whether ground and backdrop are there.

    Raises
    ------
    InputError
        A texture is missing or no image.
    """
    patches = design.patches if pages else design.popup_patches
    materials: list[Material] = [PAPER, PAGE, _reverse(design)]
    triangles, uvs, indices = [], [], []
    for patch in patches:
        corners = _triangles(patch)
        front = _bare(patch)
        uv = np.zeros((len(corners), 3, 2))
        if patch.texture is not None and patch.texture_frame is not None:
            front = len(materials)
            materials.append(Material(_ground(patch), _image(patch.texture, textures)))
            uv, printed = _printed(patch, corners)
            corners, uv = (corners, uv) if printed else (corners[:, ::-1], uv[:, ::-1])
        if poses is not None:
            corners = transform(poses[patch.id], corners.reshape(-1, 3)).reshape(-1, 3, 3)
        triangles += [corners, corners[:, ::-1]]
        uvs += [uv, np.zeros_like(uv)]
        indices += [np.full(len(corners), front), np.full(len(corners), REVERSE)]
    return Surface(np.concatenate(triangles), np.concatenate(uvs), np.concatenate(indices), tuple(materials))


def _reverse(design: Design) -> Material:
    """The side of the paper that is not printed."""
    from PIL import ImageColor

    if design.card.reverse is None:
        return PAPER
    return Material(np.array([*ImageColor.getrgb(design.card.reverse), 255]) / 255)


def _bare(patch: Patch) -> int:
    """Index of the material of a patch without a print."""
    return 1 if patch.id in (GROUND_ID, BACKDROP_ID) else 0


def _ground(patch: Patch) -> FloatArray:
    """What the colours of a print are multiplied by, shape (4,): pages show their paper, patches the model."""
    return PAPER.colour if patch.id in (GROUND_ID, BACKDROP_ID) else np.ones(4)


def _triangles(patch: Patch) -> FloatArray:
    """The patch as triangles, counterclockwise about the normal of its plane, shape (n, 3, 3)."""
    from mapbox_earcut import triangulate_float64

    plane = patch.plane
    rings = [plane.flat(ring) for ring in (patch.points, *patch.hole_points)]
    vertices = np.concatenate(rings)
    ends = np.cumsum([len(ring) for ring in rings]).astype(np.uint32)
    faces = np.asarray(triangulate_float64(vertices, ends), dtype=np.int64).reshape(-1, 3)
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    turned = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) < (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    faces[turned] = faces[turned][:, ::-1]
    return plane.lift(vertices[faces])


def _printed(patch: Patch, corners: FloatArray) -> tuple[FloatArray, bool]:
    """Texture coordinates (n, 3, 2), and whether the corners run counterclockwise seen from the printed side."""
    assert patch.texture_frame is not None  # asked by the caller
    frame = patch.texture_frame
    right, up = np.array(frame.right), np.array(frame.up)
    rel = corners - np.array(frame.origin)
    uv = np.stack([rel @ right / (right @ right), rel @ up / (up @ up)], axis=-1)
    return uv, bool(np.cross(right, up) @ patch.plane.normal > 0)


def _image(path: str, textures: Textures) -> UInt8Array:
    from PIL import Image, UnidentifiedImageError

    if isinstance(textures, Path):
        data = read_bytes(textures / path, "texture")
    elif path in textures:
        data = textures[path]
    else:
        raise InputError(f"texture {path} is not among the images given; give one for each patch that names one")
    try:
        with Image.open(BytesIO(data)) as image:
            return np.asarray(image.convert("RGBA"))
    except (UnidentifiedImageError, OSError):
        raise InputError(f"texture {path} is not an image; give a PNG file") from None
