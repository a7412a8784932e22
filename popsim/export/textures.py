"""Images of textures: read once, put on white paper, and packed small enough to print."""

from functools import lru_cache
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from popsim.errors import InputError

if TYPE_CHECKING:
    from PIL.Image import Image

LARGE = 300_000
"""Bytes; a picture that is larger without loss is a photograph, which JPEG packs better than anything."""

QUALITY = 92
"""Of JPEG: no artefacts that a printer shows."""


@lru_cache(maxsize=64)
def read_texture(root: Path, name: str) -> "Image":
    """Return the image `name` in the folder `root` as RGB; what is transparent becomes white paper.

    Raises
    ------
    InputError
        The file is missing or no image.
    """
    from PIL import Image as Pillow

    path = root / name
    try:
        with Pillow.open(path) as image:
            if image.mode == "RGB":
                return image.copy()
            clear = image.convert("RGBA")
    except FileNotFoundError:
        raise InputError(f"texture {path} does not exist; keep the textures beside the design") from None
    except (OSError, ValueError) as error:
        raise InputError(f"texture {path} cannot be read as an image ({error})") from None
    paper = Pillow.new("RGBA", clear.size, "white")
    return Pillow.alpha_composite(paper, clear).convert("RGB")


@lru_cache(maxsize=64)
def packed_texture(root: Path, name: str) -> tuple[bytes, str]:
    """Bytes of the image and their format, "PNG" or, for photographs, "JPEG"; errors as :func:`read_texture`."""
    image = read_texture(root, name)
    exact = _exact(root / name, image)
    if len(exact) <= LARGE:
        return exact, "PNG"
    small = BytesIO()
    image.save(small, "JPEG", quality=QUALITY, subsampling=0)
    return (small.getvalue(), "JPEG") if small.tell() < len(exact) / 2 else (exact, "PNG")


def _exact(path: Path, image: "Image") -> bytes:
    """The image as PNG: its own file where that is one and nothing in it is transparent."""
    from PIL import Image as Pillow

    with Pillow.open(path) as stored:
        if stored.format == "PNG" and stored.mode == "RGB":
            return path.read_bytes()
    packed = BytesIO()
    image.save(packed, "PNG")
    return packed.getvalue()
