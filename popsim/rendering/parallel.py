"""Work on many rays in chunks: bounded memory, two threads, always in the same order."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")

CHUNK = 1 << 16  # rays; a chunk's float64 temporaries then stay within the processor's cache
THREADS = 2  # tracing frees the interpreter; more threads only wait for numpy


def map_chunks(work: Callable[[slice], T], count: int, chunk: int = CHUNK) -> list[T]:
    """Return `work` of consecutive slices of range(count), in order (one empty slice if count is 0)."""
    slices = [slice(low, min(low + chunk, count)) for low in range(0, count, chunk)] or [slice(0, 0)]
    if len(slices) == 1:
        return [work(slices[0])]
    with ThreadPoolExecutor(THREADS) as pool:
        return list(pool.map(work, slices))
