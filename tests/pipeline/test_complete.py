"""Hinges get more paper where no flap fits."""

from pathlib import Path
from typing import Any

import pytest

from popsim.layout import NoFlapError
from popsim.patches import PatchSettings
from popsim.pipeline import RunSettings
from popsim.pipeline import complete as completing
from popsim.pipeline.complete import ROUNDS, complete
from popsim.pipeline.deliver import Delivery

SETTINGS = RunSettings(patches=PatchSettings(dpi=40))


class Printer:
    """Stands for design and delivery; a flap fits where a pair of patches is held on some share of its hinge."""

    def __init__(self, needed: dict[frozenset[str], float]) -> None:
        self.needed, self.seen = needed, [SETTINGS]

    def run_design(self, path: Path, settings: RunSettings, progress: Any) -> Any:
        self.seen.append(settings)
        return settings

    def deliver(self, run: Any, folder: Path, **_: Any) -> Delivery:
        for pair, share in self.needed.items():
            if run.patches.share(pair) < share:
                raise NoFlapError("no flap fits", pair)
        return Delivery((folder,), None)


def completed(printer: Printer, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    said: list[str] = []
    for name in ("run_design", "deliver"):
        monkeypatch.setattr(completing, name, getattr(printer, name))
    complete(Path("m"), SETTINGS, Path("o"), command="", footer=lambda run: "", force=False, progress=said.append)
    return said


def test_a_hinge_gets_twice_the_paper_until_its_flap_fits(monkeypatch: pytest.MonkeyPatch) -> None:
    one, other = frozenset({"M1.L", "M1.T_G"}), frozenset({"M1.R", "B"})
    printer = Printer({one: 0.8, other: 0.5})
    assert len(completed(printer, monkeypatch)) == 3
    assert printer.seen[-1].patches.share(one) == 1.0
    assert printer.seen[-1].patches.share(other) == 0.5
    assert printer.seen[-1].patches.share(frozenset({"M1.L", "G"})) == SETTINGS.patches.least_share


def test_what_fits_at_once_is_designed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    printer = Printer({})
    assert completed(printer, monkeypatch) == []
    assert printer.seen == [SETTINGS, SETTINGS]


def test_a_hinge_that_is_too_short_in_whole_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(NoFlapError):
        completed(Printer({frozenset({"M1.L", "G"}): 1.1}), monkeypatch)


def test_there_is_an_end_to_it(monkeypatch: pytest.MonkeyPatch) -> None:
    printer = Printer({frozenset({f"M{k}.L", "G"}): 0.5 for k in range(ROUNDS + 1)})
    with pytest.raises(NoFlapError):
        completed(printer, monkeypatch)
    assert len(printer.seen[-1].patches.held) == ROUNDS
