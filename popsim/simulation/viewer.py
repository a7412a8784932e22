"""A design as MJCF for MuJoCo's own viewer: the card closes by a slider."""

import numpy as np

from popsim.design import Design, Patch
from popsim.simulation.forest import PAGES, TreeJoint, spanning_forest
from popsim.simulation.mjcf import Recipe, body_tree, loops, mass_and_joint, options, size_of
from popsim.simulation.plates import mesh_assets, mesh_geoms, prisms
from popsim.simulation.solver import BRISK
from popsim.simulation.turning import free_turns

PAPER_SKIN = 5e-4
"""Half thickness of the drawn plates, over the size of the pop-up."""

DAMPING = 20.0
"""Joint damping over inertia, 1/s: a hand on the slider is not smooth."""

PAGE_MASS = 100.0
"""Of a plate: the pages are held by a hand, and the pop-up does not move them."""

DEGREES = 2 * 180 / np.pi
"""Degrees of fold angle per radian of one page."""

SERVO = 20.0
"""1/s; how fast the pages follow the slider, without swinging over."""

PAGE_LOOK, PATCH_LOOK = ' rgba="0.93 0.9 0.82 1"', ' rgba="0.55 0.7 0.85 1"'
"""Colours of the pages and of the pop-up."""


def to_mjcf(design: Design) -> str:
    """MJCF of `design`, in units of the size of the pop-up.

    Its one actuator, a slider in the viewer, is called "close": degrees by which the card is closed, 0 to 180.
    Masses, preloads and solver are those of the sweep; plates are drawn and do not collide.
    """
    recipe = Recipe(size_of(design), DAMPING, BRISK.impedance)
    forest = spanning_forest(design)
    turns = free_turns(design, [joint.hinge for joint in forest.joints])
    parts = {patch.id: prisms(patch, recipe.scale, PAPER_SKIN) for patch in design.patches}
    starts = dict(zip(parts, np.cumsum([0, *map(len, parts.values())]).tolist(), strict=False))

    def content(joint: TreeJoint) -> str:
        look = mesh_geoms(starts[joint.child], parts[joint.child], PATCH_LOOK)
        return mass_and_joint(design, joint, turns, recipe) + look

    bodies = ""
    for page, side in zip(PAGES, (1, -1), strict=True):
        look = mesh_geoms(starts[page], parts[page], PAGE_LOOK)
        bodies += body_tree(_page_head(design.patch_by_id[page], side, recipe) + look, page, forest, content)
    inertia = sum(_inertia(design.patch_by_id[page], recipe) for page in PAGES) / DEGREES**2
    assets = "".join(mesh_assets(starts[name], pieces) for name, pieces in parts.items())
    return (
        f'<mujoco model="pop-up"><compiler angle="radian"/>{options(recipe, "contact")}'
        f'<custom><numeric name="mm_per_unit" data="{recipe.scale!r}"/></custom><asset>{assets}</asset>'
        '<worldbody><light pos="0 0 3" dir="0 0 -1"/><light pos="2 2 3" dir="-1 -1 -1"/>'
        f"{bodies}</worldbody><equality>{loops(forest, recipe)}"
        '<joint joint1="backdrop" joint2="ground" polycoef="0 1 0 0 0"/></equality>'
        f'<actuator><position name="close" joint="ground" gear="{DEGREES!r}" ctrlrange="0 180" '
        f'kp="{inertia * SERVO**2!r}" kv="{2 * inertia * SERVO!r}"/></actuator></mujoco>\n'
    )


def _page_head(page: Patch, side: int, recipe: Recipe) -> str:
    inertia = _inertia(page, recipe)
    joint = "ground" if side == 1 else "backdrop"
    return (
        f'<body name="{page.id}"><inertial pos="0 0 0" mass="{PAGE_MASS}" '
        f'diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>'
        f'<joint name="{joint}" type="hinge" axis="{side} 0 0" limited="true" range="0 {np.pi / 2!r}"/>'
    )


def _inertia(page: Patch, recipe: Recipe) -> float:
    """Of a page about the fold, in units of the model."""
    return PAGE_MASS * float(np.abs(page.points).max() / recipe.scale) ** 2
