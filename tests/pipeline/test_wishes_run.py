"""Edit and keep: a run, its wishes file edited, and the run that follows it."""

from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest
import trimesh
from refusal import refused

from popsim.cli.choices import chosen_fold
from popsim.design import dump_design
from popsim.errors import InputError
from popsim.mesh.alignment import align
from popsim.patches import PatchSettings
from popsim.pipeline import DesignRun, RunSettings, run_design
from popsim.pipeline.deliver import WISHES, deliver
from popsim.pipeline.prepare import Stance
from popsim.pipeline.wishes import Hand, load_wishes

HOUSE = [*product((0, 60), (0, 40), (0, 20)), (30, 0, 50), (30, 40, 50)]
"""Corners of a house whose ridge runs along its shorter side."""


def again(run: DesignRun, hand: Hand) -> DesignRun:
    """What becomes of the model of a run by a file of wishes."""
    assert hand.size is not None
    fit, stance = replace(run.settings.fit, wishes=hand.wishes), Stance(fold=chosen_fold("auto", hand))
    settings = replace(
        run.settings, stance=stance, fit=fit, size=hand.size, exact_size=True, wishes_for=hand.sha256
    )
    return run_design(run.prepared.model.path, settings)


def delivered(run: DesignRun, folder: Path) -> Path:
    """The file of wishes that a run leaves in a folder."""
    files, _ = deliver(run, folder, command="popsim design", footer="", force=False)
    assert folder / WISHES in files
    return folder / WISHES


@pytest.fixture(scope="module")
def house(tmp_path_factory: pytest.TempPathFactory) -> DesignRun:
    path = tmp_path_factory.mktemp("models") / "house.stl"
    trimesh.PointCloud(np.array(HOUSE, dtype=float)).convex_hull.export(path)
    return run_design(path, RunSettings(patches=PatchSettings(dpi=50)))


@pytest.fixture(scope="module")
def wishes(house: DesignRun, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return delivered(house, tmp_path_factory.mktemp("run") / "out")


def test_the_file_of_a_run_gives_the_same_design(truck: DesignRun, tmp_path: Path) -> None:
    """Also if nothing else comes of the run."""
    repeated = again(truck, load_wishes(delivered(refused(truck), tmp_path / "out")))
    assert dump_design(repeated.design) == dump_design(truck.design)
    assert not any("another model" in note for note in repeated.notes)


def test_an_edited_number_is_kept_and_verified(house: DesignRun, wishes: Path) -> None:
    box, tent = house.fit.mechanisms
    (top,) = box.parameters()["tops"]
    edited = wishes.with_name("edited.yaml")
    edited.write_text(wishes.read_text().replace(f"height: {top['height']!r}", f"height: {top['height'] - 6!r}"))
    run = again(house, load_wishes(edited))
    assert [lower["height"] for lower in run.fit.mechanisms[0].parameters()["tops"]] == [top["height"] - 6]
    assert run.fit.mechanisms[1].parameters() == tent.parameters()
    assert run.verdict.passed
    assert [part.type for part in run.verdict.evidence.sweep.design.mechanisms] == [box.type, tent.type]


def test_the_fold_that_fitting_chose_is_kept(house: DesignRun, wishes: Path) -> None:
    assert house.prepared.alignment.fold == "short" != align(house.prepared.model).fold
    hand = load_wishes(wishes)
    repeated = again(house, hand)
    assert repeated.prepared.alignment.axes == house.prepared.alignment.axes
    assert [part.parameters() for part in repeated.fit.mechanisms] == [
        part.parameters() for part in house.fit.mechanisms
    ]
    with pytest.raises(
        InputError, match="the wishes are stated for a fold along the short side; leave out --fold"
    ):
        chosen_fold("long", hand)


def test_wishes_for_another_model_are_told(house: DesignRun, wishes: Path) -> None:
    run = again(house, replace(load_wishes(wishes), sha256="0" * 64))
    assert any("the wishes were written for another model" in note for note in run.notes)
