"""A design as MJCF, MuJoCo's XML."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape

import numpy as np
import numpy.typing as npt

from popsim.design import Design, Patch
from popsim.geometry.arrays import FloatArray
from popsim.simulation.forest import PAGES, Forest, TreeJoint
from popsim.simulation.solver import ITERATIONS, LOOP_SOLREF, PRELOAD, TIMESTEP
from popsim.simulation.turning import Turn

FREELY = 4 * np.pi
"""rad; a limit that is never reached."""


@dataclass(frozen=True)
class Recipe:
    """What a model is made with.

    Attributes
    ----------
    scale:
        mm per unit of length of the model.
    damping:
        Joint damping over inertia, 1/s.
    impedance:
        How much of the reference acceleration of loops and limits is enforced.
    """

    scale: float
    damping: float
    impedance: float


def size_of(design: Design) -> float:
    """Greatest extent of the pop-up without its pages (of the pages where there is nothing else), mm."""
    patches = design.popup_patches or design.patches
    points = np.concatenate([patch.points for patch in patches])
    return float(np.ptp(points, axis=0).max())


def write_mjcf(design: Design, forest: Forest, turns: Mapping[str, Turn], recipe: Recipe) -> str:
    """MJCF of `design` with ground and backdrop as mocap bodies; poses are relative to the open pose.

    `turns` holds how far each hinge turns, by its id.
    """

    def content(joint: TreeJoint) -> str:
        return mass_and_joint(design, joint, turns, recipe)

    bodies = "".join(body_tree(f'<body name="{page}" mocap="true">', page, forest, content) for page in PAGES)
    return (
        '<mujoco model="pop-up"><compiler angle="radian"/>'
        f"{options(recipe, 'autoreset contact')}"
        f"<worldbody>{bodies}</worldbody><equality>{loops(forest, recipe)}</equality></mujoco>"
    )


def options(recipe: Recipe, disabled: str) -> str:
    """Solver, time step and defaults; `disabled` lists flags of MuJoCo that are switched off."""
    flags = " ".join(f'{flag}="disable"' for flag in disabled.split())
    impedance = f"{recipe.impedance} {recipe.impedance}"
    return (
        f'<option timestep="{TIMESTEP}" gravity="0 0 0" solver="Newton" integrator="implicitfast" '
        f'tolerance="1e-12" iterations="{ITERATIONS}"><flag {flags}/></option>'
        f'<default><equality solref="{LOOP_SOLREF}" solimp="{impedance}"/>'
        f'<joint solreflimit="{LOOP_SOLREF}" solimplimit="{impedance}"/></default>'
    )


def loops(forest: Forest, recipe: Recipe) -> str:
    """Two equalities per hinge that closes a loop, one at each end of its axis."""
    return "".join(
        f'<connect body1="{escape(hinge.patches[0])}" body2="{escape(hinge.patches[1])}" '
        f'anchor="{text(point / recipe.scale)}"/>'
        for hinge in forest.loops
        for point in hinge.points
    )


def body_tree(head: str, page: str, forest: Forest, content: Callable[[TreeJoint], str]) -> str:
    """A page and all that hangs on it: `head` opens its body, `content` fills those of the others.

    Written without recursion, because towers may be deep.
    """
    parts = [head]
    stack: list[TreeJoint | None] = [*reversed(forest.hanging_on(page))]
    while stack:
        joint = stack.pop()
        if joint is None:
            parts.append("</body>")
            continue
        parts.append(f'<body name="{escape(joint.child)}">{content(joint)}')
        stack.append(None)
        stack.extend(reversed(forest.hanging_on(joint.child)))
    return "".join(parts) + "</body>"


def text(values: npt.ArrayLike) -> str:
    """Numbers as MJCF attributes hold them, to the last bit."""
    return " ".join(repr(float(value)) for value in np.ravel(np.asarray(values, float)))


def mass_and_joint(design: Design, joint: TreeJoint, turns: Mapping[str, Turn], recipe: Recipe) -> str:
    """Inertia and joint of a body.

    All plates weigh the same and turn alike: only where they can go matters, not how.
    """
    patch = design.patch_by_id[joint.child]
    points = patch.points / recipe.scale
    centre = points.mean(axis=0)
    inertia = float(((points - centre) ** 2).sum(axis=1).max())
    axis = _axis(patch, joint)
    extra = _limits(turns[joint.hinge.id], joint, axis)
    if joint.hinge.crease is not None:
        extra += f' springref="{np.pi!r}" stiffness="{PRELOAD * inertia!r}"'
    return (
        f'<inertial pos="{text(centre)}" mass="1" diaginertia="{text([inertia] * 3)}"/>'
        f'<joint name="{escape(joint.hinge.id)}" type="hinge" pos="{text(joint.hinge.points[0] / recipe.scale)}" '
        f'axis="{text(axis)}" damping="{recipe.damping * inertia!r}"{extra}/>'
    )


def _axis(patch: Patch, joint: TreeJoint) -> FloatArray:
    """Unit direction of a joint.

    Flat creases turn positively: the crease bulges to its normal, so the far end of the child goes to the other
    side.
    """
    hinge = joint.hinge
    axis: FloatArray = (hinge.points[1] - hinge.points[0]) / hinge.length
    if hinge.crease is None:
        return axis
    rises = np.cross(axis, patch.points - hinge.points[0]) @ np.array(hinge.crease)
    return axis if rises[np.argmax(np.abs(rises))] < 0 else -axis


def _limits(turn: Turn, joint: TreeJoint, axis: FloatArray) -> str:
    """How far the child turns before it would pass through its parent; flat creases go to one side only."""
    along = (joint.hinge.points[1] - joint.hinge.points[0]) @ axis > 0
    lower, upper = turn.lower, turn.upper
    if along != (joint.hinge.patches[1] == joint.child):
        lower, upper = -upper, -lower
    if joint.hinge.crease is not None:
        lower = 0.0
    if not (np.isfinite(lower) or np.isfinite(upper)):
        return ""
    return f' limited="true" range="{text(np.clip([lower, upper], -FREELY, FREELY))}"'
