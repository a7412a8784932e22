"""What a search goes out from: a model over a fold, and what candidates over it are worth."""

from dataclasses import dataclass
from functools import cached_property

from popsim.design import Card
from popsim.fitting.appearance import Appearance
from popsim.fitting.candidate import Candidate
from popsim.fitting.depths import deepened
from popsim.fitting.greedy import Grower
from popsim.fitting.kept import first_candidate
from popsim.fitting.manners import SECOND, Manner
from popsim.fitting.refit import Climber, Value, valued
from popsim.fitting.settings import FitSettings
from popsim.fitting.subject import Subject

BUDGET, LAST_BUDGET = 34, 160
"""Evaluations for refitting at first, and for completing."""

FINE = 2
"""Times as many pixels a side by which borders find their last place."""

FINE_STEPS, FINE_BUDGET = (0.6, 0.25), 66
"""Cells by which borders are moved at last, and evaluations for that."""

THINNEST = 0.03
"""Least extent of a prism or a step, as a share of the model's longest side: 4.5 mm on 150, for scissors."""


@dataclass(frozen=True, eq=False)
class Outset:
    """A model over a fold, the candidate that all others grow from, and what the user says of them.

    Attributes
    ----------
    subject:
        The model.
    start:
        The empty card, or what the user keeps on it.
    settings:
        Of the fit.
    """

    subject: Subject
    start: Candidate
    settings: FitSettings

    @staticmethod
    def of(subject: Subject, settings: FitSettings) -> "Outset":
        """The outset of a model.

        Raises
        ------
        InputError
            What the user keeps does not fold, or has more patches than are allowed.
        """
        size = float((subject.bounds[1] - subject.bounds[0]).max())
        card = Card(x=(-20 * size, 20 * size), depth=20 * size)
        start = first_candidate(card, THINNEST * size, settings.wishes, settings.most_patches)
        return Outset(subject, start, settings)

    @cached_property
    def coarse(self) -> Appearance:
        """How candidates appear beside the model."""
        return Appearance(self.subject.scene, self.subject.bounds)

    @cached_property
    def fine(self) -> Appearance:
        """The same with more pixels."""
        return Appearance(self.subject.scene, self.subject.bounds, FINE)

    @cached_property
    def value(self) -> Value:
        """What candidates are worth."""
        return self._value(self.coarse)

    def begun(self, manner: Manner) -> Candidate:
        """Where a manner leads to."""
        return manner.begun(self.subject, self.start, self.settings)

    def refitted(self, state: Candidate) -> Candidate:
        """After a first refitting."""
        return self._climber.refit(state, BUDGET)

    def completed(self, state: Candidate) -> Candidate:
        """With prisms added, refitted, with the depths of all plates."""
        return self.deepened(self._climber.complete(state, LAST_BUDGET))

    def deepened(self, state: Candidate) -> Candidate:
        """With the depths of all plates chosen."""
        return deepened(state, self.value)

    def polished(self, state: Candidate) -> Candidate:
        """With each border at its last place, and the depths of all plates."""
        fine = self._value(self.fine)
        return self.deepened(Climber(fine, self._climber.grower).refit(state, FINE_BUDGET, FINE_STEPS))

    @cached_property
    def _climber(self) -> Climber:
        grower = Grower(self.subject.volume, self.subject.planes, SECOND.taste(self.subject, self.settings))
        return Climber(self.value, grower)

    def _value(self, appearance: Appearance) -> Value:
        """What candidates are worth by how they appear."""

        def work(candidate: Candidate) -> float:
            if candidate.patches > self.settings.most_patches:
                return -1.0
            overall = appearance.likeness(candidate.mechanisms, candidate.depths).overall
            return overall - self.settings.patch_likeness * candidate.patches

        return valued(work)
