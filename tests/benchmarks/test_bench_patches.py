"""What cutting and printing patches costs: with the number of patches, and with the resolution."""

from itertools import pairwise
from pathlib import Path

import numpy as np
from conftest import Report, cpu_seconds, exponent

from popsim.design import Card
from popsim.geometry.surface import Surface
from popsim.mechanisms import card_pair
from popsim.mechanisms.box_fold import BoxFold, Top
from popsim.mesh.loading import load_model
from popsim.patches import PatchSettings
from popsim.patches.cut import cut
from popsim.patches.paint import paint_cut
from popsim.rendering.ray_scene import RayScene

LENGTH = 150.0
LAYERS = (1, 3, 5, 7)
"""Steps of the staircase; seven make about forty patches."""

RESOLUTIONS = (75.0, 150.0, 300.0)


def truck(models: Path) -> Surface:
    """The truck on its card, upright, LENGTH long."""
    surface = load_model(models / "truck" / "truck.obj").surface
    low, high = surface.bounds
    placed = np.eye(4)
    placed[:3, :3] = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]]) * LENGTH / float((high - low).max())
    low, high = surface.transformed(placed).bounds
    placed[:3, 3] = [*-(low + high)[:2] / 2, -low[2]]
    return surface.transformed(placed)


def staircase(surface: Surface, steps: int) -> BoxFold:
    """A box-fold around a surface whose tops fall towards the front."""
    x, y, z = surface.bounds[1]
    card = Card(x=(-2 * x, 2 * x), depth=3 * (y + z))
    ends = np.linspace(-x, x, steps + 1)
    tops = [Top(a, b, z * (1 - 0.08 * k)) for k, (a, b) in enumerate(pairwise(ends))]
    return BoxFold.stepped("M1", card_pair(card), y, tuple(tops))


def test_prints_by_patches_and_resolution(models: Path, report: Report) -> None:
    surface = truck(models)
    scene, box = RayScene(surface), {"M1": np.array([surface.bounds[0] - 1, surface.bounds[1] + 1])}
    for title, cases in (
        ("patches", [(steps, 300.0) for steps in LAYERS]),
        ("resolution", [(LAYERS[-1], dpi) for dpi in RESOLUTIONS]),
    ):
        rows, sizes, costs = [], [], []
        for steps, dpi in cases:
            fold, settings = staircase(surface, steps), PatchSettings(dpi=dpi)
            found = cut([fold], scene, box, settings)
            cutting = cpu_seconds(lambda fold=fold, settings=settings: cut([fold], scene, box, settings))
            printing = cpu_seconds(lambda found=found, settings=settings: paint_cut(found, scene, settings))
            sizes.append(dpi if title == "resolution" else len(found.outlines))
            costs.append(cutting + printing)
            rows.append((len(found.outlines), dpi, cutting, printing))
        power = exponent(sizes, costs)
        report(f"prints by {title}, exponent {power:.2f}", ("patches", "dpi", "outlines, s", "prints, s"), rows)
