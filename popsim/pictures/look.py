"""From where pictures are taken, and how large they are."""

from dataclasses import dataclass

from popsim.errors import InputError


@dataclass(frozen=True)
class Look:
    """How pictures are taken.

    Attributes
    ----------
    azimuth, elevation:
        Of the eye, degrees; azimuth 0 is the front (+x), 90 the side of the ground page.
    width, height:
        Of each picture, pixels.
    """

    azimuth: float = 35.0
    elevation: float = 25.0
    width: int = 640
    height: int = 480

    def __post_init__(self) -> None:
        if not (-90 <= self.elevation <= 90):
            raise InputError(f"the elevation must lie between -90 and 90 degrees, not {self.elevation:g}")
        if not (16 <= self.width <= 8000 and 16 <= self.height <= 8000):
            raise InputError(f"pictures measure 16 to 8000 pixels, not {self.width} x {self.height}")
