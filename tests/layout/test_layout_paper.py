"""Paper formats and settings."""

import pytest

from popsim.layout import PAPERS, LayoutError, LayoutSettings, find_paper


@pytest.mark.parametrize(
    ("name", "width", "height"),
    [
        ("A4", 210, 297),
        ("a3", 297, 420),
        ("Letter", 215.9, 279.4),
        ("legal", 215.9, 355.6),
        ("A4 landscape", 297, 210),
        ("300x400", 300, 400),
        ("30 x 40 cm", 300, 400),
        ("12x12in", 304.8, 304.8),
    ],
)
def test_papers_by_name(name: str, width: float, height: float) -> None:
    paper = find_paper(name)
    assert (paper.width, paper.height) == pytest.approx((width, height))


def test_an_unknown_paper_is_refused_with_the_known_ones() -> None:
    with pytest.raises(LayoutError, match="A4") as error:
        find_paper("foolscap")
    assert all(paper.name in str(error.value) for paper in PAPERS.values())


@pytest.mark.parametrize("name", ["10x10", "0x100mm"])
def test_paper_too_small_to_hold_anything_is_refused(name: str) -> None:
    with pytest.raises(LayoutError, match="too small"):
        find_paper(name)


def test_settings_refuse_what_makes_no_sense() -> None:
    with pytest.raises(LayoutError, match="flap_depth"):
        LayoutSettings(flap_depth=0)
    with pytest.raises(LayoutError, match="margins"):
        LayoutSettings(margin=50).area(find_paper("100x100"))
