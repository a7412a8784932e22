"""Ways in which joints are brought together and pressed."""

from enum import Enum


class Way(Enum):
    """How a step is done; its value is what the report says."""

    LAID = "laid from above and pressed down flat"
    SLID = "slid in along the plane in which it lies; its flaps are folded onto it and pressed down flat"
    FOLDED = "folded over and pressed down flat"
    CLOSED = "glued open, then folded as in the finished pop-up and pressed down flat"
    TUCKED = "tucked in between layers, out of sight, and pressed down flat"
    HELD = "held open and pressed between two fingers"
    BROUGHT = "brought to its place held open, then folded as in the finished pop-up and pressed down flat"

    @property
    def lying(self) -> bool:
        """Whether nothing is held open by hand until it sticks; else the joint is made standing up."""
        return self not in (Way.HELD, Way.BROUGHT)
