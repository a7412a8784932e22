"""The wishes file: what a run chose comes back as it was, and what cannot be is refused in one line."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.design import Source
from popsim.errors import InputError
from popsim.mechanisms import MECHANISMS
from popsim.pipeline.wishes import parse_wishes, wishes_text
from popsim.verification.random_designs.growth import Limits, grow

SOURCE = Source(file="truck.obj", sha256="ab" * 32)
BOX = "{id: M1, type: box-fold, base: [G, B], parameters: {half_width: 20, tops: [[0, 40, 30]], end_pairs: []}}"
ON_TOP = "{id: A, type: tent-fold, base: [M1.T_G, M1.T_B], parameters: {x: [5, 30], t1: 10, height: 12}}"


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_what_was_chosen_comes_back(seed: int) -> None:
    parts = grow(np.random.default_rng(seed), Limits(1, 12, 4)).parts
    command = "popsim design truck.obj"
    text = wishes_text(parts, size=143.2101, fold="short", most_patches=90, source=SOURCE, command=command)
    hand = parse_wishes(text)
    assert (hand.size, hand.fold, hand.most_patches, hand.sha256) == (143.2101, "short", 90, SOURCE.sha256)
    assert not hand.wishes.add
    number = {part.id: f"M{k}" for k, part in enumerate(parts, 1)}
    for part, kept in zip(parts, hand.wishes.kept, strict=True):
        assert (kept.type, kept.id) == (part.type, number[part.id])
        assert kept.parameters() == part.parameters()
        owner, _, role = part.pair.patches[1].partition(".")
        assert kept.pair.patches[1] == (f"{number[owner]}.{role}" if role else owner)
        assert (kept.pair.u, kept.pair.v) == pytest.approx((part.pair.u, part.pair.v), abs=1e-9)


def test_an_entry_of_a_design_can_be_pasted_as_it_is() -> None:
    entry = BOX[:-1] + ", patches: [M1.L, M1.R], closing_range: [-20, 60]}"
    assert parse_wishes(f"size: 15cm\nkeep: [{entry}, {ON_TOP}]").wishes.kept[1].pair.v == 30


def test_json_is_read_too() -> None:
    hand = parse_wishes('{"forbid": ["tent-fold"], "most_patches": 30, "keep_out": [{"x": [9, -5]}], "size": 120}')
    assert hand.wishes.forbidden == {"tent-fold"}
    assert hand.wishes.keep_out[0].bounds[:, 0].tolist() == [-5, 9]
    assert np.isfinite(hand.wishes.keep_out[0].bounds).all()


def test_an_empty_file_wishes_nothing() -> None:
    assert parse_wishes("# nothing\n").wishes.kept == ()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("forbid: [pleat]", "forbid: there is no mechanism 'pleat'; expected one of box-fold"),
        (f"forbid: [{', '.join(MECHANISMS)}]", "forbid: all mechanisms are forbidden"),
        ("forbid: v-fold-1", "forbid: input should be a valid tuple"),
        ("keeep: []", "keeep: extra inputs are not permitted"),
        ("most_patches: 1", "most_patches: input should be greater than or equal to 2"),
        ("size: wide", "size: 'wide' is not a length"),
        ("size: .inf", "holds NaN or infinity"),
        ("keep_out: [{x: [0, .nan]}]", "holds NaN or infinity"),
        (f"keep: [{BOX}]", "size: missing; keep, keep_out and pin are in mm"),
        ("[1, 2]", "expected fields such as forbid and keep, found list"),
        ("keep: [", "neither YAML nor JSON"),
        ("\x00", "neither YAML nor JSON"),
        ("version: 2", "version: input should be 1"),
        ("size: 9\npin: [{type: roof, region: {}}]", "pin: there is no mechanism 'roof'"),
        (
            f"size: 9\nkeep: [{ON_TOP}]",
            r"keep: A: nothing offers the base \[M1.T_G, M1.T_B\]; the card and earlier",
        ),
        (f"size: 9\nkeep: [{BOX}, {BOX}]", "keep: two entries are called M1"),
        (f"size: 9\nkeep: [{BOX.replace('20', '-20')}]", "keep: M1: half_width of a box-fold must be positive"),
        (
            f"size: 9\nkeep: [{BOX.replace('half_width', 'width')}]",
            "keep: M1: a box-fold has no parameter 'width'",
        ),
        (f"size: 9\nkeep: [{BOX.replace('box-fold', 'step-fold')}]", "keep: M1: a step-fold has no parameter"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words) as caught:
        parse_wishes(text, name="w.yaml")
    assert re.fullmatch(r"w\.yaml: [^\n]+", str(caught.value))
