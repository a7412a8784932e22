"""What decides how patches are cut and painted."""

from dataclasses import dataclass, field

from popsim.errors import InputError
from popsim.stock import HINGE_LENGTH, HINGE_SHARE, NEAR_EDGE, THINNEST_STRIP, least_hold

MM_PER_INCH = 25.4

BASES = ("none", "outline", "print")
"""What may be printed on ground and backdrop: nothing, a line around what stands there, or what lies there."""


@dataclass(frozen=True)
class PatchSettings:
    """How patches are cut and painted.

    Attributes
    ----------
    dpi:
        Resolution of the textures.
    pixel:
        Side of the pixels in which silhouettes are found, mm.
    tolerance:
        How far an outline may deviate from the silhouette, mm.
    thinnest:
        Paper and holes narrower than this are not cut, mm.
    snap:
        A silhouette nearer than this to a hinge reaches it, mm.
    seam:
        The same for hinges between two patches of one mechanism: a gap beside an edge shows more than paper.
    least_share, least_length:
        A hinge holds where it has this share of its line and this length, mm (or all of a shorter line).
    bleed:
        How far the print reaches beyond the cut, mm.
    base:
        What is printed on ground and backdrop, one of :data:`BASES`.
    reverse:
        Colour of the side of the paper that is not printed, as #rrggbb; None for plain paper.
    within_face:
        Ids of patches that must stay within their faces: what verification found in the way.
    held:
        Pairs of patch ids whose hinge must have twice as much of its line, each time that they are listed: no flap
        fitted on less.
    """

    dpi: float = 300.0
    pixel: float = 0.2
    tolerance: float = 0.3
    thinnest: float = THINNEST_STRIP
    snap: float = NEAR_EDGE
    seam: float = 2.5
    least_share: float = HINGE_SHARE
    least_length: float = HINGE_LENGTH
    bleed: float = 1.5
    base: str = "outline"
    reverse: str | None = None
    within_face: frozenset[str] = field(default_factory=frozenset)
    held: tuple[frozenset[str], ...] = ()

    def __post_init__(self) -> None:
        if not 30 <= self.dpi <= 1200:
            raise InputError(f"textures need 30 to 1200 dpi, not {self.dpi:g}")
        for name in ("pixel", "tolerance", "thinnest", "snap", "seam", "least_length"):
            if not getattr(self, name) > 0:
                raise InputError(f"patch setting {name} must be positive, not {getattr(self, name):g} mm")
        if not 0 < self.least_share <= 1 or self.bleed < 0:
            raise InputError(
                f"a hinge needs a share in (0, 1] and a bleed of at least 0 mm, not {self.least_share:g} and "
                f"{self.bleed:g}"
            )

        if self.base not in BASES:
            raise InputError(f"the base pages can show {', '.join(BASES)}, not {self.base!r}")

    @property
    def print_pixel(self) -> float:
        """Side of a printed pixel, mm."""
        return MM_PER_INCH / self.dpi

    def share(self, patches: frozenset[str]) -> float:
        """Share of its line that the hinge between two patches must have, 0..1."""
        return min(self.least_share * 2.0 ** self.held.count(patches), 1.0)

    def least_hold(self, length: float) -> float:
        """How much of a line of some length, mm, must be held for its hinge to hold, mm."""
        return least_hold(length, self.least_share, self.least_length)
