"""What cannot be laid out."""

from popsim.errors import InputError


class LayoutError(InputError):
    """A design does not go onto the paper; the message states what would."""
