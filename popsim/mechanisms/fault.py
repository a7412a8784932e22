"""Where a mechanism can be spoiled so that it does not fold any more: the negative controls of Sec. 3.3.1."""

from dataclasses import dataclass

from popsim.geometry.arrays import FloatArray, locked


@dataclass(frozen=True, eq=False)
class Fault:
    """A line of the open pose whose shift breaks an identity between lengths, and leaves all patches planar.

    Attributes
    ----------
    identity:
        What it breaks, as the paper writes it.
    roles:
        The plates whose corners on the line move, with the hinges between them and to the base.
    line:
        Ends of the line, shape (2, 3), mm.
    shift:
        Unit direction of the shift, shape (3,); the mechanism stays within the room it has.
    most:
        How far it can be shifted, mm.
    """

    identity: str
    roles: tuple[str, ...]
    line: FloatArray
    shift: FloatArray
    most: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "line", locked(self.line, (2, 3), "line"))
        object.__setattr__(self, "shift", locked(self.shift, (3,), "shift"))
