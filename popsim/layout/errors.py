"""What cannot be laid out."""

from popsim.errors import InputError


class LayoutError(InputError):
    """A design does not go onto the paper; the message states what would."""


class NoFlapError(LayoutError):
    """A hinge that has room for a flap on neither side.

    Attributes
    ----------
    patches:
        Ids of the two patches.
    """

    def __init__(self, message: str, patches: frozenset[str]) -> None:
        super().__init__(message)
        self.patches = patches

    @property
    def between(self) -> str:
        """Both patches in words."""
        return " and ".join(sorted(self.patches))
