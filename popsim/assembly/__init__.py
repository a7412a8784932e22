"""How to put the pieces together: an order that was executed, steps as scenes and in words (Sec. 4.4, [APH*03]).

The finished pop-up lies folded as a stack of paper; it is taken apart in thought, and every step of that is
executed. Backwards, the same steps put it together.
"""

from popsim.assembly.ease import Ease
from popsim.assembly.evidence import Evidence
from popsim.assembly.kind import StepKind
from popsim.assembly.plan import AssemblyPlan, plan_assembly
from popsim.assembly.scene import FlapKey, Scene, flap_key
from popsim.assembly.step import Step

__all__ = [
    "AssemblyPlan",
    "Ease",
    "Evidence",
    "FlapKey",
    "Scene",
    "Step",
    "StepKind",
    "flap_key",
    "plan_assembly",
]
