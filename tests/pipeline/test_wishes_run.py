"""Edit and keep: a run, its wishes file edited, and the run that follows it."""

from dataclasses import replace
from pathlib import Path

import pytest

from popsim.cli.choices import chosen_fold
from popsim.design import dump_design
from popsim.errors import InputError
from popsim.mesh.alignment import align
from popsim.patches import PatchSettings
from popsim.pipeline import DesignRun, RunSettings, run_design
from popsim.pipeline.deliver import WISHES, deliver
from popsim.pipeline.prepare import Stance
from popsim.pipeline.wishes import Hand, load_wishes

QUICK = RunSettings(patches=PatchSettings(dpi=50))


def again(path: Path, hand: Hand) -> DesignRun:
    assert hand.size is not None
    fit, stance = replace(QUICK.fit, wishes=hand.wishes), Stance(fold=chosen_fold("auto", hand))
    settings = replace(QUICK, stance=stance, fit=fit, size=hand.size, exact_size=True, wishes_for=hand.sha256)
    return run_design(path, settings)


@pytest.fixture(scope="module")
def truck(models: Path) -> DesignRun:
    return run_design(models / "truck" / "truck.obj", QUICK)


@pytest.fixture(scope="module")
def wishes(truck: DesignRun, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("run") / "out"
    files, _ = deliver(truck, folder, command="popsim design truck.obj", footer="", force=False)
    assert folder / WISHES in files
    return folder / WISHES


def test_the_file_of_a_run_gives_the_same_design(truck: DesignRun, wishes: Path, models: Path) -> None:
    repeated = again(models / "truck" / "truck.obj", load_wishes(wishes))
    assert dump_design(repeated.design) == dump_design(truck.design)
    assert not any("another model" in note for note in repeated.notes)


def test_an_edited_number_is_kept_and_verified(truck: DesignRun, wishes: Path, models: Path) -> None:
    box = truck.fit.mechanisms[0]
    lower = min(top["height"] for top in box.parameters()["tops"])
    edited = wishes.with_name("edited.yaml")
    edited.write_text(wishes.read_text().replace(f"height: {lower!r}", f"height: {lower - 6!r}"))
    run = again(models / "truck" / "truck.obj", load_wishes(edited))
    tops = run.fit.mechanisms[0].parameters()["tops"]
    expected = [top["height"] - 6 * (top["height"] == lower) for top in box.parameters()["tops"]]
    assert [top["height"] for top in tops] == expected
    assert run.verdict.passed
    assert run.verdict.evidence.sweep.design.mechanisms[0].type == box.type


def test_the_fold_that_fitting_chose_is_kept(shared_meshes: Path, tmp_path: Path) -> None:
    path = shared_meshes / "angle_block" / "angle_block.STL"
    run = run_design(path, QUICK)
    assert run.prepared.alignment.fold == "long" != align(run.prepared.model).fold
    deliver(run, tmp_path / "out", command="popsim design angle_block.STL", footer="", force=False)
    hand = load_wishes(tmp_path / "out" / WISHES)
    repeated = again(path, hand)
    assert repeated.prepared.alignment.axes == run.prepared.alignment.axes
    assert [part.parameters() for part in repeated.fit.mechanisms] == [
        part.parameters() for part in run.fit.mechanisms
    ]
    with pytest.raises(InputError, match="the wishes are stated for a fold along the long side; leave out --fold"):
        chosen_fold("short", hand)


def test_wishes_for_another_model_are_told(wishes: Path, models: Path) -> None:
    hand = replace(load_wishes(wishes), sha256="0" * 64)
    run = again(models / "truck" / "truck.obj", hand)
    assert any("the wishes were written for another model" in note for note in run.notes)
