"""What flaps are told to keep off, beyond what a layout sees by itself."""

from dataclasses import dataclass

from popsim.geometry.arrays import FloatArray, locked
from popsim.layout.sites import Face


@dataclass(frozen=True, eq=False)
class KeepOff:
    """A line on a face of a part that no flap may cover: `line` (2, 2) in the part's flat coordinates."""

    part: str
    face: Face
    line: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "line", locked(self.line, (2, 2), "line to keep off"))
