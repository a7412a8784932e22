"""Silhouettes become outlines that scissors can follow."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import hausdorff_distance
from shapely.affinity import rotate
from shapely.geometry import MultiPolygon, Point, Polygon, box

from popsim.errors import InputError
from popsim.geometry.plane import Plane
from popsim.patches import PatchSettings
from popsim.patches.clean import common, cuttable, opened, polygons, straightened, union, without
from popsim.patches.sight import Grid
from popsim.patches.silhouette import mask_polygon

FLOOR = Plane(np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 1.0, 0]))
SETTINGS = PatchSettings()
ROOM = box(-100, -100, 100, 100)


def drawn(shape, pixel=0.2):
    """A shape as a mask on a grid, and back as a polygon."""
    import shapely

    grid = Grid.over(FLOOR, (-40, -40, 40, 40), pixel)
    mask = shapely.contains_xy(shape, *grid.centres().T).reshape(grid.shape)
    return mask_polygon(mask, grid)


@given(turn=st.floats(0, 90), width=st.floats(6, 40), height=st.floats(6, 40))
@settings(max_examples=25, deadline=None)
def test_contours_of_masks_are_true_to_less_than_two_pixels(turn, width, height):
    shape = rotate(box(-width / 2, -height / 2, width / 2, height / 2), turn)
    found = drawn(shape)
    assert isinstance(found, Polygon)
    assert hausdorff_distance(found.boundary, shape.boundary, densify=0.1) < 0.4
    assert len(found.simplify(0.18).exterior.coords) < 20


def test_contours_keep_holes_and_islands_and_leave_out_specks():
    ring = Point(0, 0).buffer(20).difference(Point(0, 0).buffer(10))
    found = drawn(union(ring, box(30, 30, 36, 36), box(-36, -36, -35.6, -35.6)))
    assert len(polygons(found)) == 2
    assert [len(part.interiors) for part in polygons(found)] == [1, 0]
    assert found.area == pytest.approx(ring.area + 36, rel=0.01)


def test_an_empty_mask_gives_an_empty_shape():
    assert drawn(Polygon()).is_empty


def test_slivers_go_and_corners_stay():
    body = box(0, 0, 20, 20)
    with_mast = union(body, box(9.5, 20, 10.5, 40))
    assert opened(with_mast, 2.0).symmetric_difference(body).area < 1e-3


def test_slits_and_small_holes_are_filled_and_large_ones_kept():
    body = box(0, 0, 30, 30)
    cut = without(without(without(body, box(5, 5, 6.5, 25)), box(10, 10, 20, 20)), box(25, 0, 26, 10))
    kept = cuttable(cut, ROOM, SETTINGS)
    assert kept.area == pytest.approx(900 - 100, abs=0.01)


def test_outlines_end_at_their_face_where_they_all_but_do():
    face = box(0, 0, 40, 20)
    shape = union(face, box(0, 20, 40, 20.4), box(10, 20, 20, 26))
    found = straightened(shape, face, SETTINGS)
    assert found.symmetric_difference(union(face, box(10, 20, 20, 26))).area < 1e-3


def test_what_is_all_but_missing_at_the_edge_of_a_face_is_filled():
    face = box(0, 0, 40, 20)
    ragged = Polygon([(0.2, 0), (39.8, 0), (40, 0.2), (40, 20), (15, 20), (15, 12), (5, 12), (5, 19.8), (0, 19.8)])
    found = straightened(ragged, face, SETTINGS)
    assert found.symmetric_difference(without(face, box(5, 12, 15, 20))).area < 1e-3


def test_a_wedge_beyond_the_face_keeps_its_slope():
    face, wedge = box(0, 0, 40, 20), Polygon([(20, 20), (40, 20), (40, 32)])
    found = straightened(union(face, wedge), face, SETTINGS)
    assert found.symmetric_difference(union(face, wedge)).area < 3.0


def test_overlays_mend_what_offsets_made_cross_itself():
    rim = [(-34.096, 3.413), (-37.496, 2.613), (-42.496, 2.0), (-47.296, 2.215), (-47.396, 2.5), (-47.391, 31.77)]
    rim += [
        (-31.206, 31.77),
        (-30.496, 31.413),
        (-29.496, 31.413),
        (-28.036, 31.77),
        (-27.4, 31.77),
        (-27.4, 5.831),
    ]
    window = [(-39.896, 17.785), (-41.096, 17.787), (-45.164, 13.9), (-42.196, 13.9), (-39.496, 14.213)]
    shape = Polygon(rim, [[*window, (-37.896, 14.613), (-37.626, 14.9)]])
    assert (
        not shape.buffer(-1, join_style="mitre", mitre_limit=3)
        .buffer(1, join_style="mitre", mitre_limit=3)
        .is_valid
    )
    found = opened(shape, 2.0)
    assert found.is_valid
    assert found.area == pytest.approx(shape.area, rel=0.01)


def test_overlays_leave_areas_only():
    touching = common(box(0, 0, 10, 10), box(10, 0, 20, 10))
    assert touching.is_empty
    assert isinstance(union(box(0, 0, 1, 1), MultiPolygon([box(5, 5, 6, 6)])), MultiPolygon)


@pytest.mark.parametrize(
    "wrong",
    [{"dpi": 5}, {"pixel": 0}, {"tolerance": -1}, {"least_share": 0}, {"bleed": -0.1}, {"snap": float("nan")}],
)
def test_settings_that_make_no_sense_are_refused(wrong):
    with pytest.raises(InputError):
        PatchSettings(**wrong)


@given(turn=st.floats(0, 180), width=st.floats(0.4, 1.6), jog=st.floats(0, 0.5))
@settings(max_examples=30, deadline=None)
def test_bars_are_widened_to_the_side_and_never_lengthened(turn, width, jog):
    upright = union(box(0, 0, width, 12), box(jog, 12, jog + width, 25))
    bar = rotate(upright, turn, origin=(0, 0))
    made = cuttable(bar, ROOM, SETTINGS)
    upright_again = rotate(made, -turn, origin=(0, 0))
    left, lower, right, upper = upright_again.bounds
    assert -0.05 <= lower < 1 and 24 < upper <= 25.05
    assert SETTINGS.thinnest <= right - left <= width + jog + SETTINGS.thinnest
    assert hausdorff_distance(made, bar) <= SETTINGS.thinnest / 2 + SETTINGS.tolerance
