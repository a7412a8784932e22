"""Hidden lines: closed forms, and the law that every spot shows the paper that is nearest."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.booklet.cutout import cutout
from popsim.booklet.eye import viewpoint
from popsim.booklet.sight import EDGE_ON, TOUCHING, Plate, see
from popsim.geometry.arrays import FloatArray
from popsim.geometry.plane import Plane
from popsim.rendering.view import View

ABOVE = View(
    eye=np.array([0.0, 0.0, 1.0]),
    up=np.array([0.0, 1.0, 0.0]),
    origin=np.zeros(3),
    low=np.zeros(2),
    size=np.ones(2),
    pixels_per_unit=1.0,
)
"""Looks straight down: picture coordinates are x and y."""


def plate(low: tuple[float, float], high: tuple[float, float], plane: Plane) -> Plate:
    return Plate(cutout(shapely.box(*low, *high), []), plane)


def level(height: float) -> Plane:
    return Plane(np.array([0.0, 0.0, height]), np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))


def sloping(angle: float, height: float = 0.0) -> Plane:
    """Turned about the y axis by `angle`, rad: it rises with x."""
    u = np.array([np.cos(angle), 0.0, np.sin(angle)])
    return Plane(np.array([0.0, 0.0, height]), u, np.array([0.0, 1.0, 0.0]))


def test_upper_plate_hides_what_it_covers() -> None:
    lower, upper = see([plate((0, 0), (10, 10), level(0)), plate((5, 5), (15, 15), level(1))], ABOVE)
    assert upper.area.area == pytest.approx(100)
    assert lower.area.area == pytest.approx(75)
    assert lower.edges.length == pytest.approx(30)
    assert lower.hidden.length == pytest.approx(10)
    assert upper.hidden.is_empty


def test_overlays_that_fail_are_taken_on_a_grid(monkeypatch: pytest.MonkeyPatch) -> None:
    """Edges that all but coincide make overlays fail, more often the more there are of them."""
    heap = [plate((k, k), (10 + k, 10 + k), level(float(k))) for k in range(4)]
    expected = see(heap, ABOVE)

    def failing(overlay: Callable[..., object]) -> Callable[..., object]:
        def only_on_a_grid(*shapes: object, grid_size: float | None = None) -> object:
            if grid_size is None:
                raise shapely.errors.GEOSException("TopologyException: Ring edge missing")
            return overlay(*shapes, grid_size=grid_size)

        return only_on_a_grid

    for name in ("difference", "intersection", "union_all"):
        monkeypatch.setattr(shapely, name, failing(getattr(shapely, name)))
    for one, other in zip(see(heap, ABOVE), expected, strict=True):
        assert one.area.area == pytest.approx(other.area.area, abs=1e-3)
        assert one.edges.length == pytest.approx(other.edges.length, abs=1e-3)
        assert one.hidden.length == pytest.approx(other.hidden.length, abs=1e-3)


def test_nothing_shows_nothing() -> None:
    assert see([], ABOVE) == ()


def test_from_below_it_is_the_other_way_round() -> None:
    below = replace(ABOVE, eye=-ABOVE.eye)
    lower, upper = see([plate((0, 0), (10, 10), level(0)), plate((5, 5), (15, 15), level(1))], below)
    assert lower.area.area == pytest.approx(100)
    assert upper.area.area == pytest.approx(75)
    assert not lower.printed


def test_crossing_plates_hide_each_other_up_to_the_line_in_which_they_meet() -> None:
    flat, slope = see([plate((-10, 0), (10, 10), level(0)), plate((-10, 0), (10, 10), sloping(np.pi / 4))], ABOVE)
    reach = 10 * np.cos(np.pi / 4)
    assert slope.area.area == pytest.approx(10 * (reach + TOUCHING), rel=1e-6)
    assert flat.area.area == pytest.approx(200 - 10 * (reach - TOUCHING), rel=1e-6)


def test_plates_that_lie_on_each_other_or_share_an_edge_stay_whole() -> None:
    one, other = see([plate((0, 0), (10, 10), level(0)), plate((5, 0), (15, 10), level(TOUCHING / 2))], ABOVE)
    assert one.area.area == other.area.area == pytest.approx(100)
    floor, wall = see([plate((-10, 0), (0, 10), level(0)), plate((0, 0), (10, 10), sloping(1.0))], ABOVE)
    assert floor.hidden.is_empty
    assert wall.hidden.is_empty


def test_plate_seen_edge_on_is_drawn_as_a_sliver() -> None:
    (wall,) = see([plate((0, 0), (10, 10), sloping(np.pi / 2))], ABOVE)
    assert wall.area.area == pytest.approx(100 * EDGE_ON, rel=1e-3)


@st.composite
def heaps(draw: st.DrawFn) -> list[Plate]:
    """Rectangles anywhere."""
    number = st.floats(-20, 20)
    plates = []
    for _ in range(draw(st.integers(2, 6))):
        normal = np.array([draw(number), draw(number), draw(number)])
        if np.linalg.norm(normal) < 1:
            normal = np.array([0.0, 0.0, 1.0])
        plane = Plane.facing(normal / np.linalg.norm(normal), np.array([draw(number), draw(number), draw(number)]))
        plates.append(plate((0, 0), (draw(st.floats(1, 30)), draw(st.floats(1, 30))), plane))
    return plates


def depths(heap: list[Plate], view: View, spot: FloatArray) -> FloatArray:
    """Depth of each plate along the ray through a spot of the picture; infinite where it is missed."""
    found = []
    for one in heap:
        origin, direction = view.to_space([*spot, 0.0]), -view.eye
        slope = direction @ one.plane.normal
        along = (one.plane.origin - origin) @ one.plane.normal / slope
        hit = shapely.contains_xy(one.cutout.shape, *one.plane.flat(origin + along * direction))
        found.append(along if hit else np.inf)
    return np.array(found)


@settings(max_examples=40, deadline=None)
@given(heaps(), st.integers(0, 2**16))
def test_every_spot_shows_the_nearest_plate(heap: list[Plate], seed: int) -> None:
    view = viewpoint()
    heap = [one for one in heap if abs(one.plane.normal @ view.eye) > 2 * EDGE_ON]
    seen = see(heap, view)
    whole = shapely.union_all([one.whole for one in seen])
    assert shapely.union_all([one.area for one in seen]).area == pytest.approx(whole.area, rel=1e-6, abs=1e-6)
    for one in seen:
        assert one.edges.length + one.hidden.length == pytest.approx(one.whole.length, rel=1e-6)
    if not heap:
        return
    rng = np.random.default_rng(seed)
    low, high = np.array(whole.bounds[:2]), np.array(whole.bounds[2:])
    for spot in rng.uniform(low, high, (20, 2)):
        distance = depths(heap, view, spot)
        order = np.sort(distance)
        if np.isfinite(order[0]) and (len(order) == 1 or order[1] - order[0] > 2 * TOUCHING):
            shown = [bool(one.area.buffer(1e-9).contains(shapely.Point(spot))) for one in seen]
            assert shown[int(distance.argmin())]
            assert sum(shown) == 1
