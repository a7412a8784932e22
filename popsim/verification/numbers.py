"""Numbers as reports hold them."""

from collections.abc import Iterable

import numpy as np

DIGITS = 6
"""Significant digits: beyond what is measured, and without the noise of the last bits."""


def numbers(values: Iterable[float]) -> list[float | None]:
    """Each of `values` as :func:`number` gives it."""
    return [number(value) for value in values]


def number(value: float) -> float | None:
    """`value` rounded to DIGITS; None for what is no finite number, which JSON cannot say."""
    return float(f"{float(value):.{DIGITS}g}") + 0.0 if np.isfinite(value) else None
