"""What executing a step shows: that it can be done, and how; or why not."""

from collections.abc import Mapping
from dataclasses import dataclass

from popsim.assembly.bundle import Bundle
from popsim.assembly.way import Way
from popsim.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Proof:
    """Joints that were brought together and pressed in simulation.

    Attributes
    ----------
    way:
        How they come together.
    joints:
        Their ids; none where something that lay open is only folded over.
    blind:
        Ids of those of which neither glue area can be seen while they come together.
    motion:
        Motion of each part from the open pose, by its id, from before to after, each of shape (k, 4, 4).
    movers:
        The parts that are moved.
    up:
        The side from which they come, unit, shape (3,).
    apart:
        What is there before: one bundle, or the two that are brought together.
    degrees:
        Fold angle at which things are held open for it; None where they lie flat.
    """

    way: Way
    joints: tuple[str, ...]
    blind: tuple[str, ...]
    motion: Mapping[str, FloatArray]
    movers: frozenset[str]
    up: FloatArray
    apart: tuple[Bundle, ...]
    degrees: float | None = None

    @property
    def is_easy(self) -> bool:
        """Whether all is pressed lying and in sight."""
        return self.way.lying and not self.blind

    @property
    def effort(self) -> tuple[bool, int]:
        """Less is easier."""
        return not self.way.lying, len(self.blind)

    @property
    def together(self) -> dict[str, FloatArray]:
        """Where everything is afterwards, by part id, each of shape (4, 4)."""
        return {name: poses[-1] for name, poses in self.motion.items()}


@dataclass(frozen=True)
class Refusal:
    """Joints that cannot be made like this.

    Attributes
    ----------
    joints:
        Their ids.
    reason:
        One line.
    blockers:
        Ids of the parts that are in the way.
    """

    joints: tuple[str, ...]
    reason: str
    blockers: tuple[str, ...] = ()
