"""Work in a second process, where there is a second core and a process can be forked safely.

A forked process has what the first one has, without starting anew. It must not build ray scenes or draw with
OpenGL: their threads and contexts do not come along. What comes out is the same as with one process.
"""

import os
import sys
import warnings
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.process import BaseProcess

T = TypeVar("T")


def forked(target: Callable[..., None], *args: object) -> "tuple[Connection[Any, Any], BaseProcess] | None":
    """Call ``target(pipe, *args)`` in a second process.

    Returns
    -------
    tuple or None
        The other end of its pipe, and the process; None where there is no second core, or no safe way.
    """
    if sys.platform != "linux" or len(os.sched_getaffinity(0)) < 2:
        return None
    from multiprocessing import get_context

    context = get_context("fork")
    here, there = context.Pipe()
    process = context.Process(target=_alone, args=(target, here, there, args), daemon=True)
    with warnings.catch_warnings():
        # of Python 3.12 on: forking beside threads; the second process needs none of their locks
        warnings.simplefilter("ignore", DeprecationWarning)
        process.start()
    there.close()
    return here, process


class Beside(Generic[T]):
    """The result of some work that is done meanwhile."""

    def __init__(self, work: Callable[[], T]) -> None:
        self._work = work
        self._started = forked(_answer, work)

    def result(self) -> T:
        """What the work returned; what it raised is raised here."""
        if self._started is None:
            return self._work()
        pipe, process = self._started
        answer: tuple[T] | None = None
        with suppress(EOFError):
            answer = pipe.recv()
        pipe.close()
        process.join()
        return self._work() if answer is None else answer[0]


def _alone(
    target: Callable[..., None], asking: "Connection[Any, Any]", pipe: Any, args: tuple[object, ...]
) -> None:
    asking.close()
    target(pipe, *args)


def _answer(pipe: "Connection[Any, Any]", work: Callable[[], object]) -> None:
    """Send what some work returns; None where it raises, so that it is done again by whoever asks."""
    answer = None
    with suppress(Exception):
        answer = (work(),)
    with suppress(BrokenPipeError):  # nobody asks any more
        pipe.send(answer)
