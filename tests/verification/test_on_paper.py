"""The second run, on paper, beside the verdict."""

import csv
import io
import json

import numpy as np
import pytest
from folding_designs import mismatched_box, plain_box, shearing_box, tower

from popsim.stock import Stock
from popsim.verification import verify
from popsim.verification.paper_report import COLUMNS, paper_csv, paper_rows

STOCK = Stock.of(200)


@pytest.fixture(scope="module")
def verdict():
    return verify(tower()[0], stock=STOCK)


def test_paper_changes_nothing_of_the_verdict():
    rigid, paper = (json.loads(verify(plain_box(), stock=stock).to_json()) for stock in (None, STOCK))
    assert rigid.pop("paper") is None
    assert paper.pop("paper")["stock"]["name"] == "200gsm"
    assert rigid == paper


@pytest.mark.parametrize(("make", "reason"), [(lambda: mismatched_box(3), "loops"), (shearing_box, "freely")])
def test_what_does_not_fold_or_stand_is_not_measured_and_says_so(make, reason):
    verdict = verify(make(), stock=STOCK)
    assert not verdict.passed
    assert verdict.paper is None
    assert any("as paper" in note and reason in note for note in verdict.notes)
    assert paper_csv(verdict.paper) == ",".join(COLUMNS) + "\n"


def test_where_loops_need_play_torque_near_the_ends_is_said_to_be_unsure():
    notes = verify(mismatched_box(0.1), stock=STOCK).notes
    assert any("torque near the open and the closed card" in note for note in notes)
    assert not any("torque near" in note for note in verify(plain_box(), stock=STOCK).notes)


def test_report_and_csv_say_the_same(verdict):
    report = json.loads(verdict.to_json())["paper"]
    rows = list(csv.reader(io.StringIO(paper_csv(verdict.paper))))
    assert tuple(rows[0]) == COLUMNS
    table = np.array(rows[1:], float)
    assert table[:, 0] == pytest.approx(report["torque"]["deg"])
    assert table[:, 1] == pytest.approx(report["torque"]["closing"])
    assert table[:, 4] == pytest.approx(report["clearance"]["narrowest"])
    assert report["stack"]["height"] == pytest.approx(report["stack"]["layers"] * 0.25)
    assert [sag["depth"] for sag in report["sag"]] == sorted((sag["depth"] for sag in report["sag"]), reverse=True)


def test_the_card_rests_where_its_torque_changes_sign(verdict):
    (rest,) = verdict.paper.torque.rests
    torque = np.interp(-rest, -verdict.paper.torque.theta, verdict.paper.torque.torque)
    assert torque == pytest.approx(0, abs=1e-9)
    assert f"rests at {np.degrees(rest):.3g} deg" in dict(paper_rows(verdict.paper))["central fold"]


def test_gaps_that_thickness_closes_early_are_told(verdict):
    assert any("touch at 5.73 deg" in note for note in verdict.notes)
    assert not any("touch" in note for note in verify(tower()[0], stock=Stock.of(80)).notes)
