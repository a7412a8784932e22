"""The figure of a step: the pieces it needs, the state before, an arrow, the state after."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from popsim.assembly import Step, StepKind
from popsim.booklet.callout import HEIGHT, draw_callout
from popsim.booklet.inks import Ink
from popsim.booklet.motions import tracks
from popsim.booklet.panel import draw_panel
from popsim.booklet.scenery import Scenery
from popsim.booklet.things import Eye
from popsim.layout.sheet import Area, Mark, Sheet
from popsim.wording import STEP

BEFORE = 0.58
"""Share of the width that the state before has: there is more to see in it."""

GAP = 6.0
"""mm between the two states, where the arrow between them is."""

AS_ONE = 1e-3
"""mm, and share of a turn, by which what moves as one may differ."""


@dataclass(frozen=True, eq=False)
class Draughtsman:
    """Draws the figures of steps."""

    eye: Eye

    def figure(self, step: Step, width: float, height: float) -> Sheet:
        """The figure of a step, `width` x `height` mm."""
        marks = list(self._marks(step, width, height))
        return Sheet(STEP.format(number=step.number), width, height, tuple(marks))

    def _marks(self, step: Step, width: float, height: float) -> Iterator[Mark]:
        layout = self.eye.layout
        fresh = [piece for piece in layout.pieces if set(piece.motions) & set(step.parts)]
        top = height
        if fresh:
            top -= HEIGHT + 2
            yield from draw_callout(layout, fresh, np.array([0.0, top + 2]), width)
        scenes = [self._before(step), self._after(step)]
        shown = [scenery for scenery in scenes if scenery is not None]
        if len(shown) == 1:
            yield from draw_panel(shown[0], np.zeros(2), np.array([width, top]))
            return
        left = BEFORE * (width - GAP)
        yield from draw_panel(shown[0], np.zeros(2), np.array([left, top]))
        yield from draw_panel(shown[1], np.array([left + GAP, 0.0]), np.array([width - GAP - left, top]))
        middle = np.array([left + GAP / 2, top / 2])
        yield Area(Ink.ARROW, (middle + np.array([[-1.6, -3.0], [1.8, 0.0], [-1.6, 3.0], [-0.4, 0.0]]),))

    def _before(self, step: Step) -> Scenery | None:
        if step.before is None or not step.before.poses:
            return None
        names = {part: piece.name for piece in self.eye.layout.pieces for part in piece.motions}
        named = {name: names[name] for name in self._named(step)}
        sights = self.eye.look(step.before, self._marked(step), step.flaps)
        ways = tracks(step, self.eye.layout, self.eye.view)
        return Scenery(sights, ways, named, self.eye.layout.numbers)

    def _after(self, step: Step) -> Scenery | None:
        if step.after is None or not step.after.poses:
            return None
        return Scenery(self.eye.look(step.after, self._marked(step)))

    def _marked(self, step: Step) -> tuple[str, ...]:
        """Parts that stand out: what moves as one, else what is new, else what flaps are glued of."""
        if step.kind is StepKind.FINISH:
            return ()
        glued = tuple(dict.fromkeys(self.eye.ends(key)[0] for key in step.flaps))
        if step.motion and not _moves_as_one(step):
            return glued
        return tuple(step.motion) or step.parts or glued

    def _named(self, step: Step) -> set[str]:
        """Parts of the pieces that are new or glued in a step."""
        touched = {name for key in step.flaps for name in self.eye.ends(key)} | set(step.parts)
        pieces = [piece for piece in self.eye.layout.pieces if touched & set(piece.motions)]
        return {part for piece in pieces for part in piece.motions}


def _moves_as_one(step: Step) -> bool:
    """Whether all that moves keeps its shape; else it is folded up."""
    ways = np.array([poses[0] @ np.linalg.inv(poses[-1]) for poses in step.motion.values()])
    return bool(np.allclose(ways, ways[:1], atol=AS_ONE))
