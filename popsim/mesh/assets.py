"""Finds the files that a model refers to (materials, textures, buffers) and remembers those that it missed.

Importing this module imports trimesh.
"""

import re
from io import BytesIO
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from PIL import Image
from trimesh.resolvers import FilePathResolver

_IMAGE_SUFFIXES = {".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".tif", ".tiff", ".webp"}
# options before the file name of an MTL map statement: -s 1 1 1, -bm 0.5, -clamp on
_MAP_OPTION = re.compile(r"^-[a-z]+(\s+(on|off|-?[\d.]+(e-?\d+)?))*\s+", re.IGNORECASE)


class AssetResolver(FilePathResolver):
    """Reads files beside the model; forgives backslashes, %20, map options and letter case.

    Attributes
    ----------
    missing:
        Names that were asked for and not found, in that order.
    unreadable:
        Names of images that were found and are not images.
    """

    def __init__(self, model: Path) -> None:
        super().__init__(str(model))
        self.missing: list[str] = []
        self.unreadable: list[str] = []

    def get(self, name: str) -> bytes:
        """Return the bytes of the file called `name`; FileNotFoundError if there is none."""
        for candidate in self._candidates(name):
            try:
                data = bytes(super().get(candidate))
            except (OSError, ValueError):
                continue
            if PurePosixPath(candidate).suffix.lower() in _IMAGE_SUFFIXES:
                self._check_image(name, data)
            return data
        if name not in self.missing:
            self.missing.append(name)
        raise FileNotFoundError(name)

    def _candidates(self, name: str) -> list[str]:
        plain = name.strip().strip('"').replace("\\", "/")
        bare = _strip_options(plain)
        names = [plain, bare, unquote(plain)]
        # an absolute path of the author's machine: the file may still stand beside the model
        names += [PurePosixPath(n).name for n in (bare, unquote(plain))]
        wanted = PurePosixPath(bare).name.lower()
        names += [p.name for p in sorted(Path(self.parent).iterdir()) if p.name.lower() == wanted]
        return [n for n in dict.fromkeys(names) if n]

    def _check_image(self, name: str, data: bytes) -> None:
        try:
            Image.open(BytesIO(data)).close()
        except (OSError, Image.DecompressionBombError):
            if name not in self.unreadable:
                self.unreadable.append(name)


def _strip_options(text: str) -> str:
    while True:
        shorter = _MAP_OPTION.sub("", text)
        if shorter == text:
            return text
        text = shorter
