"""Labels keep apart, hatching is even, arrows end where the motion ends."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
import shapely
from built_pop_up import Built
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.assembly import flap_key
from popsim.booklet.arrows import HEAD, SHORTEST, arrow, sparse
from popsim.booklet.hatch import hatched
from popsim.booklet.inks import Ink
from popsim.booklet.labels import Labels, Wish
from popsim.booklet.motions import tracks
from popsim.geometry.rigid import transform
from popsim.layout.sheet import Text, text_width
from popsim.rendering.view import View

WINDOW = shapely.box(0, 0, 80, 60)


def boxes(texts: list[Text]) -> list[shapely.Polygon]:
    half = [text_width(text.text, text.size) / 2 for text in texts]
    return [
        shapely.box(text.at[0] - w, text.at[1], text.at[0] + w, text.at[1] + 0.7 * text.size)
        for text, w in zip(texts, half, strict=True)
    ]


def test_label_stands_inside_where_there_is_room_and_beside_where_not() -> None:
    large, small = shapely.box(10, 10, 40, 40), shapely.box(50, 20, 51, 21)
    marks = list(Labels(WINDOW, large.union(small)).place([Wish("M1-a", large, 3.0), Wish("M1-b", small, 3.0)]))
    inside, beside = (mark for mark in marks if isinstance(mark, Text))
    assert large.contains(boxes([inside])[0])
    assert not small.intersects(boxes([beside])[0])
    (leader,) = (mark for mark in marks if mark.role is Ink.LEADER)
    assert small.distance(shapely.Point(leader.points[0])) == 0


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(st.floats(5, 75), st.floats(5, 55)), min_size=1, max_size=12))
def test_labels_never_overlap_nor_leave_the_window(spots: list[tuple[float, float]]) -> None:
    areas = [shapely.Point(spot).buffer(1.0) for spot in spots]
    wishes = [Wish(str(k), area, 2.4, badge=True) for k, area in enumerate(areas)]
    texts = [mark for mark in Labels(WINDOW, WINDOW).place(wishes) if isinstance(mark, Text)]
    frames = boxes(texts)
    assert all(WINDOW.contains(frame) for frame in frames)
    assert not any(one.intersects(other) for one, other in combinations(frames, 2))


def test_what_is_taken_stays_free() -> None:
    spot = shapely.box(30, 25, 32, 27)
    labels = Labels(WINDOW, spot, [shapely.box(0, 0, 80, 24.9), shapely.box(0, 0, 29, 60)])
    (text,) = (mark for mark in labels.place([Wish("7", spot, 2.4, badge=True)]) if isinstance(mark, Text))
    assert text.at[0] > 29
    assert text.at[1] > 24.9


def test_hatching_covers_evenly() -> None:
    area = shapely.Point(0, 0).buffer(20)
    lines = hatched(area, 1.0, np.pi / 4)
    assert lines.length == pytest.approx(area.area / 1.0, rel=0.02)
    assert area.buffer(1e-9).contains(lines)
    assert hatched(shapely.Polygon(), 1.0, 0.0).is_empty


def test_arrow_points_to_the_end_of_the_track() -> None:
    track = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
    shapes = arrow(track)
    head = next(shape.geometry for shape in shapes if shape.geometry.geom_type == "Polygon")
    assert head.distance(shapely.Point(track[-1])) == pytest.approx(0)
    assert head.bounds[1] == pytest.approx(10 - HEAD)
    assert arrow(np.array([[0.0, 0.0], [0.9 * SHORTEST, 0.0]])) == ()


def test_arrows_beside_each_other_become_one() -> None:
    track = np.array([[0.0, 0.0], [0.0, 30.0]])
    near, far = (track + np.array([offset, 0.0]) for offset in (3.0, 40.0))
    assert len(sparse([track, near, far])) == 2


def test_what_is_tucked_in_comes_from_beyond_its_crease(built: Built) -> None:
    layout = built.plan.layout
    step = next(step for step in built.plan.steps if len(step.flaps) == 1)
    flap = next(flap for flap in layout.flaps if flap_key(flap) in step.flaps)
    view = View(np.array([0.3, 0.5, 0.8]), np.array([0.0, 0.0, 1.0]), np.zeros(3), np.zeros(2), np.ones(2), 1.0)
    (track,) = tracks(replace(step, motion={}), layout, view)
    target = layout.parts[flap.target]

    def seen(flat: np.ndarray) -> np.ndarray:
        return view.to_plane(transform(step.before.poses[flap.target], target.plane.lift(flat)))[:, :2]

    place = np.array(flap.landing.centroid.coords)
    crease = seen(target.plane.flat(layout.parts[flap.carrier].plane.lift(flap.line)))
    assert track[-1] == pytest.approx(seen(place)[0])
    assert shapely.LineString(track).distance(shapely.LineString(crease)) < 1e-6
    sides = [np.linalg.det([crease[1] - crease[0], end - crease[0]]) for end in track]
    assert sides[0] * sides[1] < 0
