"""Images of textures, read once and checked."""

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from popsim.errors import InputError

if TYPE_CHECKING:
    from PIL.Image import Image


@lru_cache(maxsize=64)
def read_texture(root: Path, name: str) -> "Image":
    """Return the image `name` in the folder `root` as RGB or RGBA.

    Raises
    ------
    InputError
        The file is missing or no image.
    """
    from PIL import Image as Pillow

    path = root / name
    try:
        with Pillow.open(path) as image:
            image.load()
            clear = "A" in image.getbands() or "transparency" in image.info
            return image.convert("RGBA" if clear else "RGB")
    except FileNotFoundError:
        raise InputError(f"texture {path} does not exist; keep the textures beside the design") from None
    except (OSError, ValueError) as error:
        raise InputError(f"texture {path} cannot be read as an image ({error})") from None
