"""Work that a second process takes its share of, where there is a second core and it can be forked safely.

A forked process has what the first one has, without starting anew. It must not build ray scenes or draw with
OpenGL: their threads and contexts do not come along. What comes out is the same with one process; of what fails or
is lost in the second one the first one does it again.
"""

import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.process import BaseProcess
    from multiprocessing.sharedctypes import Synchronized

T = TypeVar("T")
R = TypeVar("R")


class Share(Protocol):
    """Does some work with things, in either process; what comes of each, in order."""

    def __call__(self, work: Callable[[T], R], things: Sequence[T]) -> list[R]: ...


class Second:
    """A second process that knows some works, and all that there is when it starts.

    Each process takes the next thing when it is free. Things are sent, and what comes of them is sent back.
    """

    def __init__(self, *works: Callable[[Any], Any]) -> None:
        self.works = works
        self._started = _forked(works)

    def begin(self, work: Callable[[T], R], things: Sequence[T]) -> Callable[[], list[R]]:
        """Let the second process begin with one of its works; one at a time.

        Returns
        -------
        callable
            Does the rest, and returns what comes of each thing, in order.
        """
        if self._started is None:
            return lambda: [work(thing) for thing in things]
        pipe, _, taken = self._started
        taken.value = 0
        with suppress(OSError):  # it may have died
            pipe.send((self.works.index(work), things))

        def finish() -> list[R]:
            there: dict[int, R] = {}
            try:
                own = {place: work(things[place]) for place in _taking(taken, len(things))}
            finally:
                taken.value = len(things)
                with suppress(EOFError, OSError):
                    there = pipe.recv()
            found = there | own
            return [found[place] if place in found else work(thing) for place, thing in enumerate(things)]

        return finish

    def close(self) -> None:
        """End it, whatever it does: a run that is broken off waits for nothing."""
        if self._started is not None:
            pipe, process, _ = self._started
            pipe.close()
            process.kill()
            process.join()


def begun(work: Callable[[T], R], things: Sequence[T]) -> Callable[[], list[R]]:
    """Begin to do some work with things in a second process; whoever calls what is returned does its share.

    Raises
    ------
    Exception
        When called: what the work raises.
    """

    def nth(place: int) -> R:
        return work(things[place])  # the second process has the things when it starts, so they need not be sent

    second = Second(nth)
    finish = second.begin(nth, range(len(things)))

    def results() -> list[R]:
        try:
            return finish()
        finally:
            second.close()

    return results


@contextmanager
def two_processes(*works: Callable[[Any], Any]) -> Iterator[Share]:
    """Share works, one after another, with the same second process, which remembers what it did before."""
    second = Second(*works)

    def share(work: Callable[[T], R], things: Sequence[T]) -> list[R]:
        return second.begin(work, things)() if len(things) > 1 else [work(thing) for thing in things]

    try:
        yield share
    finally:
        second.close()


def _taking(taken: "Synchronized[int]", count: int) -> Iterator[int]:
    """Places, each to one process only."""
    while True:
        with taken.get_lock():
            place = taken.value
            taken.value = place + 1
        if place >= count:
            return
        yield place


def _forked(
    works: tuple[Callable[[Any], Any], ...],
) -> "tuple[Connection[Any, Any], BaseProcess, Synchronized[int]] | None":
    """The pipe to a second process, that process, and how many things are taken.

    None where there is no second core, or no safe way.
    """
    if sys.platform != "linux" or len(os.sched_getaffinity(0)) < 2:
        return None
    from multiprocessing import current_process, get_context

    if current_process().daemon:  # those, as second ones are, may have none themselves
        return None
    context = get_context("fork")
    here, there = context.Pipe()
    taken = context.Value("i", 0)
    process = context.Process(target=_serve, args=(here, there, works, taken), daemon=True)
    with warnings.catch_warnings():
        # of Python 3.12 on: forking beside threads; the second process needs none of their locks
        warnings.simplefilter("ignore", DeprecationWarning)
        # whoever interrupts a run means the first process: the second one starts with that signal held back
        held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            process.start()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, held)
    there.close()
    return here, process, taken


def _serve(
    asking: "Connection[Any, Any]",
    pipe: "Connection[Any, Any]",
    works: tuple[Callable[[Any], Any], ...],
    taken: "Synchronized[int]",
) -> None:
    """Do what is asked until whoever asks is gone."""
    asking.close()
    with suppress(EOFError, OSError):
        while True:
            number, things = pipe.recv()
            found = {}
            for place in _taking(taken, len(things)):
                with suppress(Exception):
                    found[place] = works[number](things[place])
            pipe.send(found)
