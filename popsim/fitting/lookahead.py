"""Values of candidates one after another, where a second process works on the next one meanwhile.

A search tries one change after another and takes the first that is better, so most of what it will ask is known
before: what stands next in line. The values, and so what is found, are the same with one process.
"""

from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from popsim.beside import forked

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

T = TypeVar("T")


class Helper(NamedTuple):
    """Where a second process is asked, and by which number it knows a value."""

    number: int
    pipe: "Connection[Any, Any]"


class Valued(Generic[T]):
    """What things are worth; each is worked out once.

    Attributes
    ----------
    work:
        The value of a thing.
    key:
        Things with equal keys have one value.
    helper:
        The second process, while there is one.
    """

    def __init__(self, work: Callable[[T], float], key: Callable[[T], object]) -> None:
        self.work, self.key = work, key
        self.known: dict[object, float] = {}
        self.helper: Helper | None = None

    def __call__(self, thing: T) -> float:
        """The value of one thing."""
        key = self.key(thing)
        if key not in self.known:
            self.known[key] = self.work(thing)
        return self.known[key]

    def ahead(self, things: Iterable[T]) -> Generator[tuple[T, float]]:
        """Things with their values, in order; at most one thing more is drawn than is asked for."""
        line = iter(things)
        for thing in line:
            following = next(line, None) if self.helper and self.key(thing) not in self.known else None
            if self.helper is None or following is None or self.key(following) in self.known:
                yield thing, self(thing)
                if following is not None:
                    yield following, self(following)
                continue
            number, pipe = self.helper
            pipe.send((number, following))
            try:
                yield thing, self(thing)
            finally:
                found = pipe.recv()
                if found is not None:
                    self.known[self.key(following)] = found
            yield following, self(following)


@contextmanager
def two_processes(*values: Valued[T]) -> Iterator[None]:
    """Let a second process help with values, where there can be one."""
    started = forked(_serve, values)
    if started is None:
        yield
        return
    pipe, process = started
    try:
        for number, value in enumerate(values):
            value.helper = Helper(number, pipe)
        yield
    finally:
        for value in values:
            value.helper = None
        pipe.close()
        process.join()


def _serve(pipe: "Connection[Any, Any]", values: "tuple[Valued[T], ...]") -> None:
    """Answer what is asked until whoever asks is gone."""
    while True:
        try:
            number, thing = pipe.recv()
        except EOFError:
            return
        found = None
        with suppress(Exception):  # it is raised where the value is asked for again
            found = values[number].work(thing)
        pipe.send(found)
