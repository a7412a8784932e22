"""Fig. 16 as a table: pop-ups by voxels beside ours; and what fitting costs beside a convex decomposition."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from conftest import Report, cpu_seconds
from side_by_side import likeness
from voxel_popups import voxel_popup

from popsim.fitting import FitSettings
from popsim.patches import PatchSettings
from popsim.patches.popup_surface import popup_surface
from popsim.pipeline import DesignRun, RunSettings, run_design
from popsim.pipeline.abstract import abstract
from popsim.pipeline.prepare import Stance, prepare

OWN = ("hotel/hotel.glb", "tower/tower.ply")
SHARED = (
    "milk_truck/CesiumMilkTruck.glb",
    "apartment_block/q_building4.obj",
    "mayan_pyramid/q_mayan_temple.obj",
    "cruise_ship/q_cruise_ship.obj",
    "castle/building_castle_red.obj",
)
GRIDS = (8, 16, 32)
"""Voxels along the longest side."""

AS_PUBLISHED = {"hotel": 18, "tower": 2}
"""Patches of two box-folds and of one tent-fold: what Fig. 16 shows."""

QUICK = RunSettings(patches=PatchSettings(dpi=40))
FASTER = 10.0
"""How many times faster than the decomposition fitting is in the mean; half of that for each model."""


def test_pop_ups_by_voxels(models: Path, shared_meshes: Path, report: Report) -> None:
    rows: list[tuple[object, ...]] = []
    for path in (*(models / name for name in OWN), *(shared_meshes / name for name in SHARED)):
        name = path.parent.name
        run = run_design(path, QUICK)
        scene, bounds = run.prepared.scene, run.prepared.bounds
        rows.append((name, "ours", *_measured(run)))
        if name in AS_PUBLISHED:
            few = replace(QUICK, fit=FitSettings(most_patches=AS_PUBLISHED[name]))
            rows.append(("", "ours, as few as published", *_measured(run_design(path, few))))
        for grid in GRIDS:
            voxels = voxel_popup(scene.opaque(), bounds, grid)
            theirs = likeness(scene, bounds, voxels.surface)
            rows.append(("", f"{grid} voxels", voxels.columns, voxels.patches, *theirs, "not tried"))
    heads = ("model", "approach", "mechanisms", "patches", "silhouette", "relief", "folds")
    report("pop-ups by voxels beside ours (Fig. 16)", heads, rows)


def _measured(run: DesignRun) -> tuple[object, ...]:
    bare = run.verdict.evidence.sweep.design
    shown = likeness(run.prepared.scene, run.prepared.bounds, popup_surface(bare, {}, pages=False))
    return len(run.fit.mechanisms), len(run.design.popup_patches), *shown, run.verdict.passed


@pytest.mark.usefixtures("compiled")
def test_fitting_beside_convex_decomposition(models: Path, shared_meshes: Path, report: Report) -> None:
    """Each model is fitted once, as by whoever designs it."""
    coacd = pytest.importorskip("coacd", reason="the extra `bench` is not installed")
    coacd.set_log_level("error")
    rows, ratios = [], []
    for path in (
        *(models / name for name in ("truck/truck.obj", *OWN)),
        *(shared_meshes / name for name in SHARED),
    ):
        prepared = prepare(path, Stance(), 150.0, 0)
        corners = prepared.surface.triangles.reshape(-1, 3).round(6)
        points, index = np.unique(corners, axis=0, return_inverse=True)
        mesh = coacd.Mesh(points, index.reshape(-1, 3))
        parts: list[object] = []
        ours = cpu_seconds(lambda prepared=prepared: abstract(prepared, FitSettings(), 0), rounds=1)
        theirs = cpu_seconds(lambda mesh=mesh, parts=parts: parts.extend(coacd.run_coacd(mesh, seed=0)), rounds=1)
        ratios.append(theirs / ours)
        rows.append((path.parent.name, len(index) // 3, ours, theirs, len(parts), ratios[-1]))
    mean = float(np.exp(np.log(ratios).mean()))
    heads = ("model", "triangles", "fitting, s", "CoACD, s", "convex parts", "ratio")
    report(f"fitting beside CoACD, {mean:.1f} times faster in the geometric mean", heads, rows)
    assert mean >= FASTER
    assert min(ratios) >= FASTER / 2
