"""Functions on arrays, compiled."""

from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import ParamSpec, TypeVar, cast

from numba import njit

from popsim import stock

P = ParamSpec("P")
R = TypeVar("R")


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """A function in machine code, which is kept for later processes where there is a place for it.

    What is kept goes by a name that changes with each file that it comes from: Numba itself looks only at the file
    of the function, not at those of what it calls.
    """
    return _compiled(function, set())


def summing(function: Callable[P, R]) -> Callable[P, R]:
    """The same for a function whose sums come to the same in any order, so that it may add several at once."""
    return _compiled(function, {"reassoc", "nsz"})


def _compiled(function: Callable[P, R], liberties: set[str]) -> Callable[P, R]:
    function.__qualname__ = f"{function.__qualname__}_{_version()}"
    try:
        found = njit(cache=True, error_model="numpy", fastmath=liberties)(function)
    except RuntimeError:  # neither the folder of the file nor any cache of the user can be written
        found = njit(error_model="numpy", fastmath=liberties)(function)
    return cast(Callable[P, R], found)


@cache
def _version() -> str:
    """What changes with the text of any function or constant that may be compiled."""
    files = [Path(stock.__file__), *sorted(Path(__file__).parent.glob("*.py"))]
    return sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:12]
