"""Fig. 16 as a table: pop-ups by voxels beside ours; and what fitting costs beside a convex decomposition."""

from pathlib import Path

import numpy as np
import pytest
from conftest import Report, cpu_seconds
from side_by_side import likeness
from voxel_popups import voxel_popup

from popsim.fitting import FitSettings
from popsim.patches import PatchSettings
from popsim.patches.popup_surface import popup_surface
from popsim.pipeline import RunSettings, run_design
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

QUICK = RunSettings(patches=PatchSettings(dpi=40))
FASTER = 10.0
"""Than the decomposition: what is asked of fitting."""


def test_pop_ups_by_voxels(models: Path, shared_meshes: Path, report: Report) -> None:
    rows: list[tuple[object, ...]] = []
    for path in (*(models / name for name in OWN), *(shared_meshes / name for name in SHARED)):
        run = run_design(path, QUICK)
        scene, bounds = run.prepared.scene, run.prepared.bounds
        bare = run.verdict.evidence.sweep.design
        ours = likeness(scene, bounds, popup_surface(bare, {}, pages=False))
        boxes = len(run.fit.mechanisms)
        rows.append((path.parent.name, "ours", boxes, len(run.design.popup_patches), *ours, run.verdict.passed))
        for grid in GRIDS:
            voxels = voxel_popup(scene.opaque(), bounds, grid)
            theirs = likeness(scene, bounds, voxels.surface)
            rows.append(("", f"{grid} voxels", voxels.columns, voxels.patches, *theirs, "not tried"))
    heads = ("model", "approach", "mechanisms", "patches", "silhouette", "relief", "folds")
    report("pop-ups by voxels beside ours (Fig. 16)", heads, rows)


@pytest.mark.parametrize("name", ["truck/truck.obj", "hotel/hotel.glb"])
def test_fitting_beside_convex_decomposition(name: str, models: Path, report: Report) -> None:
    coacd = pytest.importorskip("coacd", reason="the extra `bench` is not installed")
    coacd.set_log_level("error")
    prepared = prepare(models / name, Stance(), 150.0, 0)
    points, index = np.unique(prepared.surface.triangles.reshape(-1, 3).round(6), axis=0, return_inverse=True)
    mesh = coacd.Mesh(points, index.reshape(-1, 3))
    parts: list[object] = []
    ours = cpu_seconds(lambda: abstract(prepared, FitSettings(), 0), rounds=1)
    theirs = cpu_seconds(lambda: parts.extend(coacd.run_coacd(mesh, seed=0)), rounds=1)
    heads = ("triangles", "fitting, s", "CoACD, s", "convex parts", "ratio")
    report(f"fitting {name} beside CoACD", heads, [(len(index) // 3, ours, theirs, len(parts), theirs / ours)])
    assert theirs >= FASTER * ours
