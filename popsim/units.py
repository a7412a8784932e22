"""Lengths and colours as people write them; inside popsim they are millimetres and #rrggbb."""

import math
import re

from popsim.errors import InputError

_MM = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, '"': 25.4, "pt": 25.4 / 72}


def parse_length(text: str, name: str) -> float:
    """Return a length in mm; a bare number is millimetres.

    Raises
    ------
    InputError
        The text is no positive length.
    """
    match = re.fullmatch(r'\s*([0-9]*\.?[0-9]+(?:e[+-]?[0-9]+)?)\s*(mm|cm|m|in|pt|")?\s*', text, re.IGNORECASE)
    value = float(match[1]) * _MM[(match[2] or "mm").lower()] if match else math.nan
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{name}: {text!r} is not a length; write for example 150mm, 15cm or 6in")
    return value


def parse_scale(text: str, name: str) -> float:
    """Return a scale, as "1:87" or "0.5", as a factor.

    Raises
    ------
    InputError
        The text is no positive scale.
    """
    match = re.fullmatch(r"\s*([0-9]*\.?[0-9]+)\s*(?::\s*([0-9]*\.?[0-9]+))?\s*", text)
    below = float(match[2] or 1) if match else 0.0
    value = float(match[1]) / below if match and below > 0 else 0.0
    if not value > 0:
        raise InputError(f"{name}: {text!r} is not a scale; write for example 1:87 or 0.5")
    return value


def parse_colour(text: str, name: str) -> str:
    """Return a colour as #rrggbb; names of CSS are known.

    Raises
    ------
    InputError
        The text is no opaque colour.
    """
    from PIL import ImageColor

    try:
        parts: tuple[int, ...] = ImageColor.getrgb(text.strip())
    except ValueError:
        parts = ()
    if len(parts) != 3:
        raise InputError(f"{name}: {text!r} is not a colour; write for example #aa3311 or navy")
    return "#" + "".join(f"{part:02x}" for part in parts)
