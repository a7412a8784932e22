"""Answers that a second process helps to find.

A search tries one change after another and takes the first that is better, so most of what it will ask is known
before: what stands next in line; the second process works on that meanwhile (:meth:`Known.ahead`). Where all
answers are needed, each process takes the next question when it is through with its last (:meth:`Known.all`). What
is asked may be the value of a candidate, or a whole climb from one. The answers are the same with one process.
"""

from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from popsim.beside import forked

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.sharedctypes import Synchronized

T = TypeVar("T")
R = TypeVar("R")


class Helper:
    """A second process, which does one thing at a time."""

    def __init__(self, pipe: "Connection[Any, Any]", taken: "Synchronized[int]") -> None:
        self._pipe, self._taken = pipe, taken
        self.free = True

    def ask(self, number: int, thing: object) -> None:
        """Let it work on a thing by the work of that number."""
        self.free = False
        self._pipe.send((number, thing))

    def answer(self) -> tuple[Any] | None:
        """What it found, once it has; None where that failed."""
        found: tuple[Any] | None = self._pipe.recv()
        self.free = True
        return found

    def share(self, number: int, things: Sequence[T], work: Callable[[T], object]) -> list[tuple[Any] | None]:
        """What the work of that number makes of things, each done here or there; None where that failed there."""
        self.free = False
        self._taken.value = 0
        self._pipe.send((number, Shared(things)))
        try:
            own = {place: (work(things[place]),) for place in _taking(self._taken, len(things))}
        finally:
            self._taken.value = len(things)
            found: list[tuple[Any] | None] = self._pipe.recv()
            self.free = True
        return [own.get(place, there) for place, there in enumerate(found)]


class Shared(NamedTuple):
    """Things of which each process takes the next one when it is through with its last."""

    things: Sequence[Any]


def _taking(taken: "Synchronized[int]", count: int) -> Iterator[int]:
    """Places, each to one process only."""
    while True:
        with taken.get_lock():
            place = taken.value
            taken.value = place + 1
        if place >= count:
            return
        yield place


class Known(Generic[T, R]):
    """What some work makes of things; it is done once for each.

    Attributes
    ----------
    work:
        What is done with a thing.
    key:
        For things with equal keys it comes to the same.
    helper:
        The second process, while there is one, and the number by which it knows the work.
    """

    def __init__(self, work: Callable[[T], R], key: Callable[[T], object]) -> None:
        self.work, self.key = work, key
        self.known: dict[object, R] = {}
        self.helper: tuple[Helper, int] | None = None

    def __call__(self, thing: T) -> R:
        """What comes of one thing."""
        key = self.key(thing)
        if key not in self.known:
            self.known[key] = self.work(thing)
        return self.known[key]

    def ahead(self, things: Iterable[T]) -> Generator[tuple[T, R]]:
        """Things and what comes of them, in order; at most one thing more is drawn than is asked for."""
        line = iter(things)
        for thing in line:
            helper, number = self.helper or (None, 0)
            key = self.key(thing)
            following = next(line, None) if helper and helper.free and key not in self.known else None
            if helper is None or following is None or not self._new(following, key):
                yield thing, self(thing)
                if following is not None:
                    yield following, self(following)
                continue
            helper.ask(number, following)
            try:
                yield thing, self(thing)
            finally:
                found = helper.answer()
                if found is not None:
                    self.known[self.key(following)] = found[0]
            yield following, self(following)

    def all(self, things: Sequence[T]) -> list[tuple[T, R]]:
        """Things and what comes of them, in order."""
        left = list({key: thing for thing in things if (key := self.key(thing)) not in self.known}.values())
        if self.helper is not None and self.helper[0].free and len(left) > 1:
            helper, number = self.helper
            for thing, found in zip(left, helper.share(number, left, self.work), strict=True):
                if found is not None:
                    self.known[self.key(thing)] = found[0]
        return [(thing, self(thing)) for thing in things]

    def _new(self, thing: T, last: object) -> bool:
        """Whether a thing is neither known nor the same as the last one."""
        key = self.key(thing)
        return key != last and key not in self.known


@contextmanager
def two_processes(*works: Known[Any, Any]) -> Iterator[None]:
    """Let a second process help with some works, where there can be one."""
    from multiprocessing import Value

    taken = Value("i", 0)
    started = forked(_serve, works, taken)
    if started is None:
        yield
        return
    pipe, process = started
    helper = Helper(pipe, taken)
    try:
        for number, known in enumerate(works):
            known.helper = helper, number
        yield
    finally:
        for known in works:
            known.helper = None
        pipe.close()
        process.join()


def _serve(pipe: "Connection[Any, Any]", works: "tuple[Known[Any, Any], ...]", taken: "Synchronized[int]") -> None:
    """Answer what is asked until whoever asks is gone."""
    while True:
        try:
            number, thing = pipe.recv()
        except EOFError:
            return
        known = works[number]
        if isinstance(thing, Shared):
            found: Any = [None] * len(thing.things)
            for place in _taking(taken, len(found)):
                found[place] = _tried(known, thing.things[place])
        else:
            found = _tried(known, thing)
        pipe.send(found)


def _tried(work: Callable[[T], R], thing: T) -> tuple[R] | None:
    """What comes of a thing; None where that fails: it is raised where it is asked for again."""
    with suppress(Exception):
        return (work(thing),)
    return None
