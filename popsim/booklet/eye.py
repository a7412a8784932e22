"""From where everything in a booklet is seen."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from popsim.rendering.view import View

AZIMUTH, ELEVATION = 35.0, 38.0
"""Degrees; the same side as in other pictures of pop-ups, a little higher, so that flat paper is well seen."""


def viewpoint() -> "View":
    """Parallel rays along which every drawing of a booklet is made; its plane coordinates are mm."""
    from popsim.rendering.view import View

    azimuth, elevation = np.radians([AZIMUTH, ELEVATION])
    flat = np.cos(elevation)
    eye = np.array([flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)])
    up = np.array([0.0, 0.0, 1.0])
    return View(eye, up, origin=np.zeros(3), low=np.zeros(2), size=np.ones(2), pixels_per_unit=1.0)
