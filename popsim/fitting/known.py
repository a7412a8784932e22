"""Answers that are worked out once."""

from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")
R = TypeVar("R")


class Known(Generic[T, R]):
    """What some work makes of things; it is done once for each.

    Attributes
    ----------
    work:
        What is done with a thing.
    key:
        For things with equal keys it comes to the same.
    """

    def __init__(self, work: Callable[[T], R], key: Callable[[T], object]) -> None:
        self.work, self.key = work, key
        self._known: dict[object, R] = {}

    def __call__(self, thing: T) -> R:
        """What comes of a thing."""
        key = self.key(thing)
        if key not in self._known:
            self._known[key] = self.work(thing)
        return self._known[key]
