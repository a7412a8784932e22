"""Ways in which joints are brought together and pressed."""

from enum import Enum

from popsim import wording


class Way(Enum):
    """How a step is done; its value is what the report says."""

    LAID = wording.WAY_LAID
    SLID = wording.WAY_SLID
    FOLDED = wording.WAY_FOLDED
    CLOSED = wording.WAY_CLOSED
    TUCKED = wording.WAY_TUCKED
    HELD = wording.WAY_HELD
    BROUGHT = wording.WAY_BROUGHT

    @property
    def lying(self) -> bool:
        """Whether nothing is held open by hand until it sticks; else the joint is made standing up."""
        return self not in (Way.HELD, Way.BROUGHT)
