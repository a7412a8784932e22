"""Swinging things aside, one after another, until something comes off."""

from collections import deque
from collections.abc import Callable, Iterable

from popsim.assembly.bundle import Bundle
from popsim.assembly.cut import Cut
from popsim.assembly.proof import Proof
from popsim.assembly.stack import Stack
from popsim.assembly.trial import Trial

STATES = 40
"""States that are looked at before the search is given up."""

SWINGS = 4
"""Things that are swung aside one after another at most: more do not lie still."""

Chain = tuple[Proof, ...]
"""Steps one after another; the last undoes something."""


def swung_aside(bundle: Bundle, stack: Stack, number: int, wanted: Callable[[Iterable[Cut]], list[Cut]]) -> Chain:
    """With all folded up again: the fewest things swung aside so that something can be undone lying.

    Parameters
    ----------
    bundle:
        What is taken apart.
    number:
        Of the first sheet that is swung aside.
    wanted:
        Of some cuts those that are worth a try, the best first.

    Returns
    -------
    The swings and what is undone after them; empty where nothing was found. States in which the same lines are
    open count as one.
    """
    start = frozenset[tuple[str, ...]]()
    seen = {start}
    waiting: deque[tuple[Bundle, Chain, frozenset[tuple[str, ...]]]] = deque([(bundle.folded(), (), start)])
    for _ in range(STATES):
        if not waiting:
            break
        now, path, opened = waiting.popleft()
        trial = Trial(now, stack, number + len(path))
        for cut in wanted(trial.cuts):
            if isinstance(proof := trial.cut(cut), Proof):
                return (*path, proof)
        for cut in trial.cuts if len(path) < SWINGS else ():
            after = opened | {cut.line}
            if not cut.taken and after not in seen and isinstance(proof := trial.cut(cut), Proof):
                seen.add(after)
                waiting.append((proof.apart[0], (*path, proof), after))
    return ()
