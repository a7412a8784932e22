"""From a model to a folder: what is made, and what is kept back."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from refusal import refused

from popsim.geometry.rigid import transform
from popsim.layout import LayoutSettings, find_paper
from popsim.patches import PatchSettings
from popsim.pipeline import DesignRun, RunSettings, run_design
from popsim.pipeline.deliver import UNVERIFIED, deliver
from popsim.pipeline.prepare import Stance

QUICK = PatchSettings(dpi=60)


@pytest.fixture(scope="module")
def crane(tmp_path_factory: pytest.TempPathFactory) -> DesignRun:
    """A mast with a jib, from which something hangs."""
    path = tmp_path_factory.mktemp("models") / "crane.stl"
    parts = (((-6, -6, 0), (6, 6, 120)), ((6, -6, 100), (90, 6, 112)), ((70, -6, 85), (78, 6, 100)))
    trimesh.util.concatenate([trimesh.creation.box(bounds=np.array(part)) for part in parts]).export(path)
    return run_design(path, RunSettings(stance=Stance(up="z"), patches=QUICK))


def test_truck_passes_and_looks_like_a_truck(truck: DesignRun) -> None:
    assert truck.verdict.passed
    assert truck.fit.likeness.silhouette > 0.85
    textured = [patch for patch in truck.design.popup_patches if patch.texture]
    assert len(textured) > len(truck.design.popup_patches) / 2


def test_design_says_where_its_model_stands(truck: DesignRun) -> None:
    to_card = np.array(truck.design.model_to_card)
    corners = transform(to_card, truck.prepared.model.surface.triangles.reshape(-1, 3))
    low, high = corners.min(axis=0), corners.max(axis=0)
    assert low[2] == pytest.approx(0, abs=1e-6)
    assert (high - low).max() == pytest.approx(150.0, rel=1e-6)
    assert abs(low[1] + high[1]) < 2.0


def test_each_page_fits_a_sheet(truck: DesignRun) -> None:
    card = truck.design.card
    page = sorted((card.x[1] - card.x[0], card.depth))
    assert (np.array(page) <= sorted(LayoutSettings().area(find_paper("A4")))).all()


def test_tall_model_is_made_smaller_and_says_so(tmp_path: Path) -> None:
    trimesh.creation.box([16, 16, 120]).export(tmp_path / "mast.ply")
    run = run_design(tmp_path / "mast.ply", RunSettings(stance=Stance(up="z"), size=250.0, patches=QUICK))
    assert run.prepared.longest < 250.0
    assert any("scaled to" in note for note in run.notes)
    assert run.verdict.passed


def test_a_jib_becomes_part_of_the_sides_of_its_mast(crane: DesignRun) -> None:
    assert crane.verdict.passed
    assert [mechanism.type for mechanism in crane.fit.mechanisms] == ["box-fold"]
    box, shapes = crane.fit.mechanisms[0], crane.painted.shapes
    low, high = box.face_box()[:, 0]
    for side in ("M1.L", "M1.R"):
        reach = np.ptp(shapes[side].outline[:, 0])
        assert reach > 2 * (high - low)
    assert crane.fit.likeness.silhouette > 0.8


def test_what_failed_is_not_exported_but_reported(crane: DesignRun, tmp_path: Path) -> None:
    files, _ = deliver(refused(crane), tmp_path / "out", command="popsim design", footer="", force=False)
    assert {file.name for file in files} == {"wishes.yaml", "report.json"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"wishes.yaml", "report.json"}
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["passed"] is False
    assert report["layout"] is None


def test_unverified_export_marks_every_sheet(crane: DesignRun, tmp_path: Path) -> None:
    import pypdfium2

    allowed = replace(crane.settings, allow_unverified=True, formats=("pdf",))
    failed = replace(refused(crane), settings=allowed)
    deliver(failed, tmp_path / "out", command="popsim design", footer="", force=False)
    document = pypdfium2.PdfDocument(tmp_path / "out" / "sheets.pdf")
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    texts = [document[k].get_textpage().get_text_range() for k in range(len(document))]
    marked = [UNVERIFIED in text for text in texts]
    assert all(marked[: report["layout"]["sheets"]])
