"""How to put the pieces together: precedence, order, steps in words (Sec. 4.4)."""

from popsim.assembly.pages import draw_steps
from popsim.assembly.plan import AssemblyPlan, Step, plan_assembly

__all__ = ["AssemblyPlan", "Step", "draw_steps", "plan_assembly"]
