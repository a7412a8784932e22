"""The MJCF for MuJoCo's viewer loads, and its slider closes and opens the card."""

import mujoco
import numpy as np
import pytest
from folding_designs import plain_box, tower, wedges

from popsim.design import Design
from popsim.simulation.forest import spanning_forest
from popsim.simulation.viewer import to_mjcf

STEPS = 2000


def slide(model: "mujoco.MjModel", data: "mujoco.MjData", start: float, end: float) -> None:
    for share in np.linspace(0, 1.25, STEPS):
        data.ctrl[0] = start + (end - start) * min(share, 1)
        mujoco.mj_step(model, data)


def largest_gap(design: Design, model: "mujoco.MjModel", data: "mujoco.MjData") -> float:
    """mm, over all hinges that close loops."""
    mujoco.mj_kinematics(model, data)
    scale = model.numeric("mm_per_unit").data[0]
    gaps = [0.0]
    for hinge in spanning_forest(design).loops:
        bodies = [data.body(name) for name in hinge.patches]
        images = [hinge.points @ body.xmat.reshape(3, 3).T + body.xpos * scale for body in bodies]
        gaps.append(np.abs(images[0] - images[1]).max())
    return max(gaps)


@pytest.mark.parametrize("design", [plain_box(), tower()[0], wedges()[0]], ids=["box", "tower", "wedges"])
def test_the_slider_closes_and_opens_the_card(design):
    model = mujoco.MjModel.from_xml_string(to_mjcf(design))
    data = mujoco.MjData(model)
    assert [model.actuator(k).name for k in range(model.nu)] == ["close"]
    assert model.actuator_ctrlrange.tolist() == [[0, 180]]
    slide(model, data, 0, 180)
    assert np.degrees(data.joint("ground").qpos[0]) == pytest.approx(90, abs=0.5)
    assert data.joint("backdrop").qpos[0] == pytest.approx(data.joint("ground").qpos[0], abs=1e-3)
    assert largest_gap(design, model, data) < 0.01
    slide(model, data, 180, 0)
    assert np.degrees(data.joint("ground").qpos[0]) == pytest.approx(0, abs=0.5)
    assert largest_gap(design, model, data) < 0.01


def test_all_patches_are_drawn_and_named():
    design = tower()[0]
    model = mujoco.MjModel.from_xml_string(to_mjcf(design))
    names = {model.body(index).name for index in range(1, model.nbody)}
    assert names == {patch.id for patch in design.patches}
    assert model.ngeom >= len(names)


def test_the_same_design_gives_the_same_text():
    assert to_mjcf(plain_box()) == to_mjcf(plain_box())
