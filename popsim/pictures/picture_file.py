"""Which picture formats are written, and how."""

from pathlib import Path
from typing import Any

from popsim.errors import InputError

FORMATS: dict[str, dict[str, Any]] = {
    ".png": {"format": "PNG"},
    ".jpg": {"format": "JPEG", "quality": 85, "optimize": True},
    ".jpeg": {"format": "JPEG", "quality": 85, "optimize": True},
}
"""What Pillow is told, by suffix."""


def save_options(path: Path) -> dict[str, Any]:
    """Return what Pillow needs to know to save a picture as its name says.

    Raises
    ------
    InputError
        The suffix is unknown.
    """
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"{path}: pictures are written as {', '.join(FORMATS)}; choose another name for --output")
    return FORMATS[path.suffix.lower()]
