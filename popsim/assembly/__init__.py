"""How to put the pieces together: precedence, order, steps as scenes and in words (Sec. 4.4)."""

from popsim.assembly.pages import draw_steps
from popsim.assembly.plan import AssemblyPlan, plan_assembly
from popsim.assembly.scene import FlapKey, Scene, flap_key
from popsim.assembly.step import Step, StepKind

__all__ = ["AssemblyPlan", "FlapKey", "Scene", "Step", "StepKind", "draw_steps", "flap_key", "plan_assembly"]
