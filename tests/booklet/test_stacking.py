"""What lies in one plane is drawn as the stack that it is."""

import numpy as np
import pytest

from popsim.assembly import AssemblyPlan, Scene
from popsim.booklet.eye import viewpoint
from popsim.booklet.stacking import LAYER, stacked
from popsim.booklet.things import Eye, Kind
from popsim.geometry.arrays import FloatArray
from popsim.simulation import Sweep


@pytest.fixture(scope="module")
def closed(plan: AssemblyPlan, sweep: Sweep) -> dict[str, FloatArray]:
    """Poses of all parts in the closed card, the ground on the table."""
    poses = {
        name: sweep.poses[sweep.closed, sweep.index[part.patch.id]] for name, part in plan.layout.parts.items()
    }
    down = np.linalg.inv(poses["G"])
    return {name: down @ pose for name, pose in poses.items()}


def shown(eye: Eye, poses: dict[str, FloatArray]) -> dict[str, float]:
    """Area that is seen of each part, mm^2."""
    sights = eye.look(Scene(poses, {}))
    return {sight.thing.name: sight.seen.area.area for sight in sights if sight.thing.kind is not Kind.FLAP}


def test_closed_card_shows_its_cover_only(plan: AssemblyPlan, closed: dict[str, FloatArray]) -> None:
    seen = shown(Eye(plan.layout, viewpoint()), closed)
    page = seen.pop("B")
    assert page > 1000
    assert sum(seen.values()) < 0.03 * page


def test_without_the_backdrop_the_sides_lie_on_top_of_what_they_enclose(
    plan: AssemblyPlan, closed: dict[str, FloatArray]
) -> None:
    inside = {name: pose for name, pose in closed.items() if name.startswith("M1.")}
    shifts = stacked(Scene(inside, {}), plan.layout, Eye(plan.layout, viewpoint()).parts)
    height = {name: float(shift[2]) for name, shift in shifts.items()}
    assert height["M1.R"] > max(height["M1.T_B"], height["M1.C"])
    assert min(height["M1.T_G"], height["M1.C"]) > height["M1.L"]
    assert min(height.values()) == 0
    assert all(round(value / LAYER, 6).is_integer() for value in height.values())


def test_what_stands_open_is_not_moved(plan: AssemblyPlan) -> None:
    poses = {name: np.eye(4) for name in plan.layout.parts}
    shifts = stacked(Scene(poses, {}), plan.layout, Eye(plan.layout, viewpoint()).parts)
    assert not np.any(list(shifts.values()))
