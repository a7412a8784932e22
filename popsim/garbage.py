"""When Python looks for garbage."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager

SELDOM = 100_000
"""Objects made since the last look for garbage; Python's own default is 700 to 2,000."""


@contextmanager
def seldom_collected() -> Iterator[None]:
    """Let Python look seldom for objects that only refer to each other.

    There are hardly any here, while looking for them among all that are kept takes a sixth of a fit's time, and a
    twentieth of that of a whole command.
    """
    before = gc.get_threshold()
    gc.set_threshold(SELDOM, *before[1:])
    try:
        yield
    finally:
        if not gc.get_freeze_count():  # what was made meanwhile is old now, without a look at it
            gc.freeze()
            gc.unfreeze()
        gc.set_threshold(*before)
