"""What stands in a booklet, whatever it is printed on."""

from collections.abc import Callable
from dataclasses import dataclass

from popsim import wording
from popsim.assembly import AssemblyPlan, Step, StepKind
from popsim.beside import begun
from popsim.booklet.closing import closing
from popsim.booklet.column import text_height
from popsim.booklet.cutting import draw_cutting
from popsim.booklet.eye import viewpoint
from popsim.booklet.figure import Draughtsman
from popsim.booklet.format import Format
from popsim.booklet.things import Eye
from popsim.layout.sheet import Sheet
from popsim.simulation import Sweep

PICTURE = "popup.png"
SIZE = 480, 360
"""The picture of the finished pop-up on the cover: its name in the folder of the design, and its pixels."""


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
    entries:
        The steps.
    banner:
        A warning on the cover, or None.
    checks:
        What to look at when it is done, one sentence each; may be empty.
    """

    name: str
    facts: str
    entries: tuple[Entry, ...]
    banner: str | None
    checks: tuple[str, ...]


def begun_booklet(
    plan: AssemblyPlan,
    sweep: Sweep,
    form: Format,
    *,
    name: str,
    banner: str | None = None,
    checks: tuple[str, ...] = (),
) -> Callable[[], Booklet]:
    """Begin to draw the figures of all steps of a plan, in a second process where there can be one.

    Parameters
    ----------
    plan:
        The steps, with their scenes.
    sweep:
        The recorded motion of what is built.
    form:
        Of the pages.
    name, banner, checks:
        As of :class:`Booklet`.

    Returns
    -------
    callable
        Draws the rest of them.
    """
    layout = plan.layout
    draughtsman = Draughtsman(Eye(layout, viewpoint()))

    def entry(step: Step) -> Entry:
        cuts = step.kind is StepKind.CUT
        height = form.figure_height(text_height(step.text, form.body, form.text_width), whole_page=cuts)
        if cuts:
            figure = draw_cutting(layout, step.number, form.width, height)
        else:
            shown = closing(step, layout, sweep) if step.kind is StepKind.FINISH else step
            figure = draughtsman.figure(shown, form.width, height)
        return Entry(step.number, step.text, figure)

    entries = begun(entry, plan.steps)
    facts = wording.FACTS.format(
        pieces=wording.counted(len(layout.pieces), wording.PIECES),
        sheets=wording.counted(layout.sheet_count, wording.SHEETS),
        paper=layout.paper.name,
        steps=wording.counted(len(plan.steps), wording.STEPS),
    )
    return lambda: Booklet(name, facts, tuple(entries()), banner, checks)
