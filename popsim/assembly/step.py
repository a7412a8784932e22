"""One step of an assembly plan."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from popsim.assembly.evidence import Evidence
from popsim.assembly.kind import StepKind
from popsim.assembly.scene import FlapKey, Scene
from popsim.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Step:
    """One thing to do.

    Attributes
    ----------
    number:
        1, 2, 3 ...
    kind:
        What is done.
    pieces:
        Names of the pieces in hand, those new in this step first.
    parts:
        Ids of the parts that are new in this step.
    joints:
        Ids of the joints that are glued, in order; none in the first and last step.
    flaps:
        Keys of the flaps that are glued.
    text:
        What to do, in English.
    before, after:
        What lies on the table before and after; None where there is nothing to see (cutting).
    motion:
        Poses of what moves from `before` to `after`, both ends included, by part id, each of shape (k, 4, 4): for
        arrows. What keeps still is not in it.
    evidence:
        What the execution of the step has shown; None where nothing is glued.
    """

    number: int
    kind: StepKind
    pieces: tuple[str, ...]
    joints: tuple[str, ...]
    text: str
    parts: tuple[str, ...] = ()
    flaps: tuple[FlapKey, ...] = ()
    before: Scene | None = None
    after: Scene | None = None
    motion: Mapping[str, FloatArray] = field(default_factory=dict)
    evidence: Evidence | None = None
