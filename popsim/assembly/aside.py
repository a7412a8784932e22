"""Swinging things aside, one after another, until something comes off."""

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

from popsim.assembly.bundle import Bundle
from popsim.assembly.cut import Cut
from popsim.assembly.proof import Proof
from popsim.assembly.trial import Trial, Trials

STATES = 40
"""States that are looked at before the search is given up."""

SWINGS = 4
"""Things that are swung aside one after another at most: more do not lie still."""

Chain = tuple[Proof, ...]
"""Steps one after another; the last undoes something."""


Opened = frozenset[tuple[str, ...]]
"""The lines that are open, each as the ids of its joints."""


class _Swing(NamedTuple):
    """A swing that may be tried next: made only when its turn comes, for most never does."""

    trial: Trial
    cut: Cut
    path: Chain
    opened: Opened


def swung_aside(bundle: Bundle, trials: Trials, number: int, wanted: Callable[[Trial], list[Cut]]) -> Chain:
    """With all folded up again: the fewest things swung aside so that something can be undone lying.

    Parameters
    ----------
    bundle:
        What is taken apart.
    trials:
        Those that were made of it in this step.
    number:
        Of the first sheet that is swung aside.
    wanted:
        Of the cuts of a trial those that are worth a try, the best first.

    Returns
    -------
    The swings and what is undone after them; empty where nothing was found. States in which the same lines are
    open count as one.
    """
    seen: set[Opened] = set()
    waiting: deque[_Swing] = deque()
    now: Bundle = bundle.folded
    path: Chain = ()
    opened: Opened = frozenset()
    while True:
        seen.add(opened)
        trial = trials.of(now, number + len(path))
        for cut in wanted(trial):
            if isinstance(proof := trial.cut(cut), Proof):
                return (*path, proof)
        if len(seen) == STATES:
            return ()
        if len(path) < SWINGS:
            waiting.extend(_Swing(trial, cut, path, opened | {cut.line}) for cut in trial.cuts if not cut.taken)
        found = _next(waiting, seen)
        if found is None:
            return ()
        now, path, opened = found


def _next(waiting: deque[_Swing], seen: set[Opened]) -> tuple[Bundle, Chain, Opened] | None:
    """The first swing that can be made and leads to what was not seen: what lies there then, and how; or None."""
    while waiting:
        swing = waiting.popleft()
        if swing.opened not in seen and isinstance(proof := swing.trial.cut(swing.cut), Proof):
            return proof.apart[0], (*swing.path, proof), swing.opened
    return None
