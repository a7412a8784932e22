"""What the user may say about a whole run."""

from dataclasses import dataclass, field

from popsim.errors import InputError
from popsim.fitting import FitSettings
from popsim.layout import LayoutSettings
from popsim.patches import PatchSettings
from popsim.pipeline.prepare import Stance

SMALLEST, LARGEST = 20.0, 2000.0
"""mm; a longest side outside this is a mistake in units rather than a wish."""


@dataclass(frozen=True)
class RunSettings:
    """All options of a design run.

    Attributes
    ----------
    size:
        Longest side of the model on the card, mm. It is made smaller if its pages would not fit a sheet, unless
        `exact_size`.
    exact_size:
        Keep `size`; pages larger than a sheet are then split over several.
    paper:
        Sheet format, e.g. "A4".
    style:
        Line style of the sheets.
    layout:
        Margins, flaps, grain, registration marks.
    two_sided:
        Print what belongs on the back of the paper on sheets of its own, mirrored.
    formats:
        Sheet formats to write.
    seed:
        Of everything random.
    allow_unverified:
        Export a design that failed verification, every sheet marked.
    """

    stance: Stance = field(default_factory=Stance)
    fit: FitSettings = field(default_factory=FitSettings)
    patches: PatchSettings = field(default_factory=PatchSettings)
    size: float = 150.0
    exact_size: bool = False
    paper: str = "A4"
    style: str = "origami"
    layout: LayoutSettings = field(default_factory=LayoutSettings)
    two_sided: bool = False
    formats: tuple[str, ...] = ("pdf", "svg")
    seed: int = 0
    allow_unverified: bool = False

    def __post_init__(self) -> None:
        if not SMALLEST <= self.size <= LARGEST:
            raise InputError(f"size must lie between {SMALLEST:g} and {LARGEST:g} mm, not {self.size:g} mm")

    def check_choices(self) -> None:
        """Raise InputError for paper, style or formats that do not exist, before any work is done."""
        from popsim.export.formats import find_writer
        from popsim.export.styles import find_style
        from popsim.layout import find_paper

        self.layout.area(find_paper(self.paper))
        find_style(self.style)
        for name in self.formats:
            find_writer(name)
