"""Contact sheets: layout, captions, refusals."""

import numpy as np
import pytest

from popsim.errors import InputError
from popsim.rendering.contact_sheet import CAPTION, GAP, contact_sheet

BELOW = 2 * CAPTION


def plain(colour, rows=40, columns=60):
    return np.full((rows, columns, 4), [*colour, 255], dtype=np.uint8)


def test_pictures_stand_in_rows_above_their_captions():
    sheet = contact_sheet([plain((255, 0, 0)), plain((0, 255, 0)), plain((0, 0, 255))], ["a", "b", "c"], 2)
    assert sheet.shape == (2 * (40 + BELOW + GAP) + GAP, 2 * (60 + GAP) + GAP, 4)
    assert sheet[GAP, GAP].tolist() == [255, 0, 0, 255]
    assert sheet[GAP + 39, 2 * GAP + 119].tolist() == [0, 255, 0, 255]
    assert sheet[2 * GAP + 40 + BELOW, GAP].tolist() == [0, 0, 255, 255]
    assert (sheet[GAP + 40 : GAP + 40 + BELOW, GAP : GAP + 60, 0] < 128).any()


def test_smaller_pictures_are_centred_and_transparency_is_white():
    small = plain((9, 9, 9), 20, 20)
    small[:10, :, 3] = 0
    sheet = contact_sheet([plain((255, 0, 0)), small], ["", ""], 2)
    left = 2 * GAP + 60 + 20
    assert sheet[GAP + 15, left].tolist() == [255, 255, 255, 255]
    assert sheet[GAP + 25, left].tolist() == [9, 9, 9, 255]
    assert sheet[GAP + 25, left - 1].tolist() == [255, 255, 255, 255]


def test_long_captions_stay_within_their_cell():
    sheet = contact_sheet([plain((255, 0, 0))], ["a caption that is far too long " * 5], 1)
    border = sheet[GAP + 40 :, : GAP - 2]
    assert (border == 255).all()


def test_refusals():
    with pytest.raises(InputError, match="2 captions"):
        contact_sheet([plain((0, 0, 0))], ["a", "b"], 1)
    with pytest.raises(InputError, match="found 0 pictures"):
        contact_sheet([], [], 1)
    with pytest.raises(InputError, match="RGBA"):
        contact_sheet([np.zeros((4, 4, 3), dtype=np.uint8)], ["a"], 1)
