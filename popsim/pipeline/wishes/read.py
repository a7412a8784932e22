"""Reading a wishes file: YAML, of which JSON is a part."""

import math
from pathlib import Path
from typing import Any

from popsim.design.file import first_problem
from popsim.errors import InputError
from popsim.files import read_bytes
from popsim.pipeline.wishes.hand import Hand, wishes_of
from popsim.pipeline.wishes.model import WishesFile
from popsim.units import parse_length

MOST_BYTES = 2**20
"""Files beyond this are refused unread."""


def load_wishes(path: Path) -> Hand:
    """Read a wishes file.

    Raises
    ------
    InputError
        It cannot be read, or cannot be met; see :func:`parse_wishes`.
    """
    content = read_bytes(path, "wishes")
    if len(content) > MOST_BYTES:
        raise InputError(f"{path}: {len(content) >> 10} KiB is more than the {MOST_BYTES >> 10} KiB that are read")
    return parse_wishes(content, name=str(path))


def parse_wishes(content: bytes | str, *, name: str = "wishes") -> Hand:
    """Make wishes of YAML or JSON text; `name` stands in the errors.

    Raises
    ------
    InputError
        It is neither, has an unknown or wrong field, names an unknown mechanism or pair, or states lengths
        without the size that they belong to.
    """
    from pydantic import ValidationError

    try:
        file = WishesFile.model_validate(_plain(content, name))
    except ValidationError as error:
        raise InputError(f"{name}: {first_problem(error.errors())}") from None
    try:
        size = None if file.size is None else parse_length(str(file.size), "size")
        if size is None and (file.keep or file.keep_out or file.pin):
            raise InputError("size: missing; keep, keep_out and pin are in mm at one size of the model")
        sha256 = None if file.source is None else file.source.sha256
        return Hand(wishes_of(file), size, file.fold, file.most_patches, sha256)
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


def _plain(content: bytes | str, name: str) -> dict[str, Any]:
    import yaml

    try:
        data = yaml.safe_load(content)
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError, ValueError) as error:
        words = " ".join(str(error).split())
        raise InputError(f"{name}: neither YAML nor JSON ({words})") from None
    if data is None:
        return {}
    if not isinstance(data, dict):
        raise InputError(f"{name}: expected fields such as forbid and keep, found {type(data).__name__}")
    if not _finite(data):
        raise InputError(f"{name}: holds NaN or infinity; all numbers must be finite")
    return data


def _finite(value: Any) -> bool:
    if isinstance(value, dict):
        return all(_finite(part) for part in value.values())
    if isinstance(value, list):
        return all(_finite(part) for part in value)
    return not isinstance(value, float) or math.isfinite(value)
