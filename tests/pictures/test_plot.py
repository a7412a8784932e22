"""The figure of what was measured: its curves are where the numbers are."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from folding_designs import mismatched_box, overlapping_boxes, plain_box, shearing_box
from PIL import Image

from popsim.errors import InputError, OutputError
from popsim.pictures.chart import GAP, HEIGHT, LEFT, RIGHT, TOP, WIDTH, Curve, Panel, Stroke, draw, size_of
from popsim.pictures.plot import PAIRS, write_plot
from popsim.stock import Stock
from popsim.verification import verify

SVG = "{http://www.w3.org/2000/svg}"


def svg_of(tmp_path: Path, design) -> ElementTree.Element:
    write_plot(tmp_path / "plot.svg", design, verify(design), "box <1>", force=True)
    return ElementTree.fromstring((tmp_path / "plot.svg").read_text())


def words(svg: ElementTree.Element) -> str:
    return "\n".join(each.text for each in svg.iter(f"{SVG}text"))


def test_a_curve_is_drawn_to_scale():
    curve = Curve(np.array([180.0, 90.0, 0.0]), np.array([1.0, 1e-2, 1e-4]), "#123456")
    shapes = draw("", [], [Panel("gap", (curve,), (("at most", 1e-3),))])
    (drawn,) = [shape for shape in shapes if isinstance(shape, Stroke) and shape.colour == "#123456"]
    across, down = np.array(drawn.points).T
    assert across == pytest.approx([LEFT, (LEFT + WIDTH - RIGHT) / 2, WIDTH - RIGHT])
    assert down == pytest.approx([TOP + HEIGHT * k / 6 for k in (1, 3, 5)])


def test_what_is_no_number_breaks_the_curve():
    curve = Curve(np.arange(5.0), np.array([1, 1, np.nan, 1, 1]), "#123456")
    shapes = draw("", [], [Panel("gap", (curve,), (("at most", 1.0),), logarithmic=False)])
    drawn = [shape for shape in shapes if isinstance(shape, Stroke) and shape.colour == "#123456"]
    assert [len(stroke.points) for stroke in drawn] == [2, 2]


def test_a_sound_design_shows_all_panels_and_no_crossing(tmp_path):
    text = words(svg_of(tmp_path, plain_box()))
    assert "box <1>: passed" in text
    assert all(part in text for part in ("loop gap", "number of free motions", "closed forms", "nothing crosses"))


def test_free_motions_are_drawn_at_each_angle_at_which_they_were_counted(tmp_path):
    """A box without end pairs shears: one motion more than a structure may have."""
    design = shearing_box()
    free = verify(design).evidence.free
    assert {motion.count for motion in free} == {1}
    svg = svg_of(tmp_path, design)
    top, one = TOP + HEIGHT + GAP, TOP + HEIGHT + GAP + HEIGHT * (1 - 1 / 1.25)
    dots = [
        (float(dot.get("cx")), float(dot.get("cy")))
        for dot in svg.iter(f"{SVG}circle")
        if top <= float(dot.get("cy")) <= top + HEIGHT
    ]
    across = [LEFT + (180 - np.degrees(motion.theta)) / 180 * (WIDTH - LEFT - RIGHT) for motion in free]
    assert np.array(dots) == pytest.approx(np.array([(x, one) for x in across]), abs=0.01)


def test_the_crossing_is_drawn_where_it_was_measured(tmp_path):
    design = overlapping_boxes()
    contact = verify(design).evidence.contacts[0]
    assert 0 <= contact.first - contact.trace[0][0] < np.radians(1)
    assert contact.depth == max(depth for _, depth in contact.trace)
    svg = svg_of(tmp_path, design)
    (line,) = [each for each in svg.iter(f"{SVG}polyline") if each.get("stroke") == PAIRS[0]]
    assert len(line.get("points").split()) == len(contact.trace)
    first = float(line.get("points").split(",")[0])
    expected = LEFT + (180 - np.degrees(contact.trace[0][0])) / 180 * (WIDTH - LEFT - RIGHT)
    assert first == pytest.approx(expected, abs=0.01)


def test_what_was_not_measured_is_said(tmp_path):
    text = words(svg_of(tmp_path, mismatched_box(2)))
    assert all(part in text for part in ("failed", "not measured", "not compared", "not judged"))


def test_png_and_svg_are_the_same_every_time(tmp_path):
    design = plain_box()
    verdict = verify(design)
    for suffix in (".png", ".svg"):
        for name in "ab":
            write_plot(tmp_path / f"{name}{suffix}", design, verdict, "box", force=False)
        assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()
    width, height = size_of([Panel("", (), ())] * 5)
    assert Image.open(tmp_path / "a.png").size == (2 * width, 2 * height)
    with pytest.raises(OutputError, match="--force"):
        write_plot(tmp_path / "a.svg", design, verdict, "box", force=False)


def test_other_suffixes_are_refused(tmp_path):
    design = plain_box()
    with pytest.raises(InputError, match=r"\.png or \.svg"):
        write_plot(tmp_path / "plot.bmp", design, verify(design), "box", force=False)


def test_paper_adds_torque_and_clearance_also_below_zero(tmp_path):
    design = plain_box()
    verdict = verify(design, stock=Stock.of(200))
    write_plot(tmp_path / "plot.svg", design, verdict, "box", force=True)
    svg = ElementTree.fromstring((tmp_path / "plot.svg").read_text())
    assert "torque that holds the card" in words(svg) and "0.25 mm thick" in words(svg)
    torque = verdict.paper.torque.torque
    assert torque.min() < 0 < torque.max()
    curve = Curve(np.array([180.0, 0.0]), np.array([-4.0, 4.0]), "#123456")
    shapes = draw("", [], [Panel("torque", (curve,), (("rest", 0.0),), logarithmic=False)])
    (drawn,) = [shape for shape in shapes if isinstance(shape, Stroke) and shape.colour == "#123456"]
    assert [y for _, y in drawn.points] == pytest.approx([TOP + 0.9 * HEIGHT, TOP + 0.1 * HEIGHT])
