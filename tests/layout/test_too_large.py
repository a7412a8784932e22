"""What exceeds a sheet is refused with the scale at which it would go onto it."""

import re

import numpy as np
import pytest
from shapely import affinity
from shapely.geometry import Polygon, box

from popsim.layout.too_large import fits, too_large

ROOM = (190.0, 254.0)


def scale_of(bare: Polygon, with_flaps: Polygon, *, grain: bool = False) -> float:
    message = str(too_large("it", bare, with_flaps, ROOM, grain=grain))
    return float(re.search(r"scale the design by ([0-9.]+) or less", message)[1])


def test_the_refusal_says_what_is_too_large_and_why() -> None:
    shape = box(0, 0, 200, 300)
    message = str(too_large("G", shape, shape, ROOM, grain=False, why="dividing it is switched off"))
    assert message == (
        "G measures 200.0 x 300.0 mm without flaps, more than the 190 x 254 mm within the margins hold, and "
        "dividing it is switched off; scale the design by 0.846 or less, or use larger paper"
    )


@pytest.mark.parametrize("grain", [False, True])
@pytest.mark.parametrize("size", [(200.0, 300.0), (260.0, 60.0), (300.0, 20.0), (100.0, 255.0)])
def test_flaps_keep_their_depth_at_the_scale_that_fits(size: tuple[float, float], grain: bool) -> None:
    width, height = size
    scale = scale_of(box(0, 0, width, height), box(-5, 0, width + 5, height + 5), grain=grain)
    for factor, expected in ((scale, True), (scale + 0.002, False)):
        assert fits(box(-5, 0, factor * width + 5, factor * height + 5), ROOM, 0.0, grain=grain) is expected


def test_what_goes_on_aslant_is_measured_aslant() -> None:
    strip = affinity.rotate(box(0, 0, 300, 20), 45)
    assert scale_of(strip, strip) == pytest.approx(254 / 300, abs=1e-3)
    assert not fits(strip, ROOM, 0.0, grain=True)
    assert fits(affinity.rotate(box(0, 0, 250, 20), 45), ROOM, 0.0)


def test_grain_keeps_what_is_turned_off_the_sheet() -> None:
    wide = box(0, 0, 240, 30)
    assert fits(wide, ROOM, 0.0)
    assert not fits(wide, ROOM, 0.0, grain=True)
    assert scale_of(wide, wide, grain=True) == pytest.approx(190 / 240, abs=1e-3)


def test_flaps_may_add_more_along_one_axis() -> None:
    shape = box(0, 0, 180, 240)
    assert fits(shape, ROOM, np.array([10.0, 14.0]))
    assert not fits(shape, ROOM, np.array([14.0, 10.0]))
