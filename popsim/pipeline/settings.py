"""What the user may say about a whole run."""

from dataclasses import dataclass, field

from popsim.fitting import FitSettings
from popsim.layout import LayoutSettings
from popsim.patches import PatchSettings
from popsim.pipeline.page import Page, given_pages
from popsim.pipeline.prepare import Scale, Stance, check_size


@dataclass(frozen=True)
class RunSettings:
    """All options of a design run.

    Attributes
    ----------
    size:
        Longest side of the model on the card, mm, or its scale. It is made smaller if its pages would not fit a
        sheet, unless `exact_size`.
    exact_size:
        Keep `size`; pages larger than a sheet are then split over several.
    card:
        What the folded card shall be, as "A5" (see :func:`popsim.pipeline.page.given_pages`); the model is made
        as large as it holds. By default as small as holds the model.
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
    calibration:
        Print the test build beside the design, into a folder of its own.
    wishes_for:
        SHA-256 of the model that the wishes were written for, or None.
    """

    stance: Stance = field(default_factory=Stance)
    fit: FitSettings = field(default_factory=FitSettings)
    patches: PatchSettings = field(default_factory=PatchSettings)
    size: float | Scale = 150.0
    exact_size: bool = False
    card: str | None = None
    paper: str = "A4"
    style: str = "origami"
    layout: LayoutSettings = field(default_factory=LayoutSettings)
    two_sided: bool = False
    formats: tuple[str, ...] = ("pdf", "svg")
    seed: int = 0
    allow_unverified: bool = False
    calibration: bool = False
    wishes_for: str | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.size, Scale):
            check_size(self.size)

    @property
    def pages(self) -> tuple[Page, ...]:
        """Pages that the given card may have; none where no card is given."""
        return () if self.card is None else given_pages(self.card)

    def check_choices(self) -> None:
        """Raise InputError for paper, style or formats that do not exist, before any work is done."""
        from popsim.export.formats import find_writer
        from popsim.export.styles import find_style
        from popsim.layout import find_paper

        self.layout.area(find_paper(self.paper))
        _ = self.pages
        find_style(self.style)
        for name in self.formats:
            find_writer(name)
