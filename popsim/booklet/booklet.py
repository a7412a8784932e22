"""What stands in a booklet, whatever it is printed on."""

from dataclasses import dataclass

from popsim import wording
from popsim.assembly import AssemblyPlan, StepKind
from popsim.booklet.closing import closing
from popsim.booklet.column import text_height
from popsim.booklet.cutting import draw_cutting
from popsim.booklet.eye import viewpoint
from popsim.booklet.figure import Draughtsman
from popsim.booklet.format import Format
from popsim.booklet.things import Eye
from popsim.layout.sheet import Sheet
from popsim.simulation import Sweep


@dataclass(frozen=True, eq=False)
class Entry:
    """One step: its number, what to do, and a figure that goes below."""

    number: int
    text: str
    figure: Sheet


@dataclass(frozen=True, eq=False)
class Booklet:
    """The content of a booklet.

    Attributes
    ----------
    name:
        Of the model.
    facts:
        How much there is to do, in a line.
    picture:
        Path of the picture of the finished pop-up, relative to the folder of the design.
    aspect:
        Width of the picture by its height.
    entries:
        The steps.
    banner:
        A warning on the cover, or None.
    checks:
        What to look at when it is done, one sentence each; may be empty.
    """

    name: str
    facts: str
    picture: str
    aspect: float
    entries: tuple[Entry, ...]
    banner: str | None
    checks: tuple[str, ...]


def make_booklet(
    plan: AssemblyPlan,
    sweep: Sweep,
    name: str,
    picture: str,
    aspect: float,
    form: Format,
    banner: str | None,
    checks: tuple[str, ...],
) -> Booklet:
    """Draw the figures of all steps of a plan for pages of a format; `sweep` is its recorded motion."""
    layout = plan.layout
    draughtsman = Draughtsman(Eye(layout, viewpoint()))
    entries = []
    for step in plan.steps:
        cuts = step.kind is StepKind.CUT
        height = form.figure_height(text_height(step.text, form.body, form.text_width), whole_page=cuts)
        if cuts:
            figure = draw_cutting(layout, step.number, form.width, height)
        else:
            shown = closing(step, layout, sweep) if step.kind is StepKind.FINISH else step
            figure = draughtsman.figure(shown, form.width, height)
        entries.append(Entry(step.number, step.text, figure))
    facts = wording.FACTS.format(
        pieces=wording.counted(len(layout.pieces), wording.PIECES),
        sheets=wording.counted(layout.sheet_count, wording.SHEETS),
        paper=layout.paper.name,
        steps=wording.counted(len(plan.steps), wording.STEPS),
    )
    return Booklet(name, facts, picture, aspect, tuple(entries), banner, checks)
