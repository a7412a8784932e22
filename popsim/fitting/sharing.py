"""Work that a second process takes its share of."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from popsim.beside import forked

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.sharedctypes import Synchronized

T = TypeVar("T")
R = TypeVar("R")


class Share(Protocol):
    """Does some work with things, in either process; what comes of each, in order."""

    def __call__(self, work: Callable[[T], R], things: Sequence[T]) -> list[R]: ...


@contextmanager
def two_processes(*works: Callable[[Any], Any]) -> Iterator[Share]:
    """Share works with a second process, where there can be one: each takes the next thing when it is free.

    What comes out is the same with one process. The second one knows what there is when it starts, and is told
    things; what comes of them must be possible to send.
    """
    from multiprocessing import Value

    taken = Value("i", 0)
    started = forked(_serve, works, taken)
    if started is None:
        yield lambda work, things: [work(thing) for thing in things]
        return
    pipe, process = started

    def share(work: Callable[[T], R], things: Sequence[T]) -> list[R]:
        if len(things) < 2:
            return [work(thing) for thing in things]
        taken.value = 0
        pipe.send((works.index(work), things))
        try:
            own = {place: work(things[place]) for place in _taking(taken, len(things))}
        finally:
            taken.value = len(things)
            there: dict[int, R] = pipe.recv()
        found = there | own
        # what failed in the second process is raised here
        return [found[place] if place in found else work(thing) for place, thing in enumerate(things)]

    try:
        yield share
    finally:
        pipe.close()
        process.join()


def _taking(taken: "Synchronized[int]", count: int) -> Iterator[int]:
    """Places, each to one process only."""
    while True:
        with taken.get_lock():
            place = taken.value
            taken.value = place + 1
        if place >= count:
            return
        yield place


def _serve(
    pipe: "Connection[Any, Any]", works: tuple[Callable[[Any], Any], ...], taken: "Synchronized[int]"
) -> None:
    """Do what is asked until whoever asks is gone."""
    while True:
        try:
            number, things = pipe.recv()
        except EOFError:
            return
        found = {}
        for place in _taking(taken, len(things)):
            with suppress(Exception):
                found[place] = works[number](things[place])
        pipe.send(found)
