import numpy as np
import pytest

from popsim.mechanisms import Plate


@pytest.mark.parametrize(
    ("degrees", "lies"), [(0.0, False), (29.0, False), (31.0, True), (90.0, True), (-31.0, True), (-29.0, False)]
)
def test_a_plate_lies_where_it_slopes_by_less_than_60_degrees(degrees: float, lies: bool) -> None:
    rise = np.radians(degrees)
    along, up = np.array([1.0, 0.0, 0.0]), np.array([0.0, -np.sin(rise), np.cos(rise)])
    square = np.array([0 * along, along, along + up, up]) * 20.0
    assert Plate("T", square, np.array([0.0, np.cos(rise), np.sin(rise)])).lies is lies
