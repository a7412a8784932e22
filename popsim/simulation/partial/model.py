"""What is half made as a model for MuJoCo: a tree on a part that is held, equalities for loops and hands."""

from collections.abc import Iterable
from html import escape

from popsim.simulation.forest import Forest, TreeJoint
from popsim.simulation.mjcf import Recipe, body_tree, loops, mass_and_joint, options
from popsim.simulation.partial.structure import Structure
from popsim.simulation.solver import BRISK

FIXED = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
"""A part that is one with its parent: how heavy it is does not matter."""


def partial_xml(structure: Structure, forest: Forest, turning: Iterable[TreeJoint], scale: float) -> str:
    """MJCF of a structure whose hinges are those of a forest, lengths over `scale`, mm; hands hold nothing yet.

    `turning` are the joints of the forest that hands can lead; seams are stiff.
    """
    recipe = Recipe(scale, BRISK.damping, BRISK.impedance)

    def content(joint: TreeJoint) -> str:
        if joint.hinge.id in structure.seams:
            return FIXED
        return mass_and_joint(structure.design, joint, structure.turns, recipe)

    bodies = body_tree(f'<body name="{escape(structure.root)}" mocap="true">', structure.root, forest, content)
    hands = "".join(
        f'<joint name="{hand_on(joint)}" joint1="{escape(joint.hinge.id)}" active="false"/>' for joint in turning
    )
    stiff = "".join(
        f'<weld body1="{escape(hinge.patches[0])}" body2="{escape(hinge.patches[1])}"/>'
        for hinge in forest.loops
        if hinge.id in structure.seams
    )
    return (
        '<mujoco model="partial"><compiler angle="radian"/>'
        f"{options(recipe, 'autoreset contact')}<worldbody>{bodies}</worldbody>"
        f"<equality>{loops(forest, recipe)}{stiff}{hands}</equality></mujoco>"
    )


def hand_on(joint: TreeJoint) -> str:
    """Name of the hand that leads a joint."""
    return escape(f"hand on {joint.hinge.id}")
