"""Marks on sheets: reverse sides, registration, names."""

import numpy as np
import pytest

from popsim.design import Design
from popsim.layout import Face, LayoutError, LayoutSettings, draw_sheets, lay_out
from popsim.layout.sheet import Area, Line, Role, Sheet, Text, text_width


def texts(sheet: Sheet) -> list[str]:
    return [mark.text for mark in sheet.marks if isinstance(mark, Text)]


def test_the_reverse_mirrors_the_places_behind(box: Design) -> None:
    layout = lay_out(box, paper="A5")
    sheets = draw_sheets(layout, two_sided=True, banner="NOT VERIFIED")
    count = layout.sheet_count
    assert count > 1
    titles = [f"Sheet {number} of {count}" for number in range(1, count + 1)]
    assert [sheet.name for sheet in sheets] == [name for title in titles for name in (title, f"{title}, reverse")]
    behind = [flap for flap in layout.flaps if flap.face is Face.REVERSE]
    areas = [mark for sheet in sheets[1::2] for mark in sheet.of(Role.GLUE) if isinstance(mark, Area)]
    assert len(areas) == len(behind)
    assert not any("(" in text for sheet in sheets[::2] for text in texts(sheet) if ":" not in text)
    assert all(any("NOT VERIFIED" in text for text in texts(sheet)) for sheet in sheets)
    flap = behind[0]
    placement = next(p for p in layout.placements if flap.target in p.piece.motions)
    whole = placement.motion @ placement.piece.motions[flap.target]
    front = np.array(flap.landing.centroid.coords[0]) @ whole[:2, :2].T + whole[:2, 2]
    centres = [area.rings[0].mean(axis=0) for area in areas]
    assert min(np.abs(centre - [layout.paper.width - front[0], front[1]]).max() for centre in centres) < 0.5


def test_reverse_sheets_are_not_cut(box: Design) -> None:
    for sheet in draw_sheets(lay_out(box), two_sided=True)[1::2]:
        assert not sheet.of(Role.CUT, Role.MOUNTAIN, Role.VALLEY)


@pytest.mark.parametrize("two_sided", [False, True])
def test_every_side_says_what_its_marks_mean(box: Design, two_sided: bool) -> None:
    layout = lay_out(box, paper="A5")
    sheets = draw_sheets(layout, two_sided=two_sided, footer="reproduced by")
    for sheet in sheets:
        reverse = sheet.name.endswith("reverse")
        words = " ".join(texts(sheet))
        for line in ("cut", "mountain fold", "valley fold"):
            assert (line in words) != reverse
        assert "flap 7 goes here" in words
        assert ("behind here" in words) != two_sided
        samples = {mark.looks for mark in sheet.of(Role.LABEL) if isinstance(mark, Line | Area)} - {None}
        assert samples == ({Role.GLUE} if reverse else {Role.CUT, Role.MOUNTAIN, Role.VALLEY, Role.GLUE})
        assert {"5 cm", "2 in"} <= set(texts(sheet))
        assert "reproduced by" in words


def test_silhouette_marks_keep_clear_of_the_pieces(box: Design) -> None:
    layout = lay_out(box, settings=LayoutSettings(registration="silhouette"))
    (sheet, *_) = draw_sheets(layout)
    marks = sheet.of(Role.REGISTRATION)
    (square,) = (mark for mark in marks if isinstance(mark, Area))
    assert np.ptp(square.rings[0], axis=0) == pytest.approx([5, 5])
    arms = [mark for mark in marks if isinstance(mark, Line)]
    assert len(arms) == 2
    assert all(np.ptp(arm.points, axis=0) == pytest.approx([20, 20]) for arm in arms)
    points = np.concatenate([mark.points for mark in sheet.of(Role.CUT) if isinstance(mark, Line)])
    assert points.min() >= 16 - 1e-6
    assert (points <= (210 - 16 + 1e-6, 297 - 16 + 1e-6)).all()


@pytest.mark.parametrize("paper", ["A4", "Letter landscape"])
def test_cricut_sheets_stay_within_what_it_prints_and_cuts(box: Design, paper: str) -> None:
    layout = lay_out(box, paper=paper, settings=LayoutSettings(registration="cricut"))
    short, long = 6.75 * 25.4, 9.25 * 25.4
    for sheet in draw_sheets(layout, footer="x " * 300, banner="NOT VERIFIED"):
        assert not sheet.of(Role.REGISTRATION)
        points = np.concatenate([mark.points for mark in sheet.marks if isinstance(mark, Line)])
        words = [mark for mark in sheet.marks if isinstance(mark, Text)]
        widths = [text_width(text.text, text.size) * (text.anchor == "start") for text in words]
        ends = [text.at + np.array([width, 0]) for text, width in zip(words, widths, strict=True)]
        points = np.concatenate([points, [text.at for text in words], ends])
        assert (np.sort(np.ptp(points, axis=0)) <= np.array([short, long]) + 1e-6).all()
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        assert np.abs(middle - [sheet.width / 2, sheet.height / 2]).max() < 10


def test_unknown_marks_are_refused() -> None:
    with pytest.raises(LayoutError, match="silhouette"):
        LayoutSettings(registration="runes")


def test_names_stand_inside_their_pieces(box: Design) -> None:
    layout = lay_out(box)
    words = [text for sheet in draw_sheets(layout) for text in texts(sheet)]
    for piece in layout.pieces:
        assert words.count(piece.name) == 1


def test_a_piece_full_of_pictures_bears_its_name_on_a_flap(box: Design) -> None:
    frame = {"origin": (0.0, 0.0, 0.0), "right": (1.0, 0.0, 0.0), "up": (0.0, 0.0, 1.0)}
    data = box.model_dump()
    for patch in data["patches"]:
        patch["texture"] = "picture.png" if patch["id"] == "M1.C" else None
        patch["texture_frame"] = {**frame, "right": (-1.0, 0.0, 0.0)} if patch["id"] == "M1.C" else None
    layout = lay_out(Design.model_validate(data))
    words = [text for sheet in draw_sheets(layout) for text in texts(sheet)]
    assert any(text.endswith(" M1-C") for text in words)
    assert "M1-C" not in words
