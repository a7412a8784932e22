"""A second process takes its share of work; what comes out is the same without it."""

import os
from time import sleep

import pytest
from popsim.fitting.sharing import two_processes

TWO_CORES = pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="there is one core only")


def squared(thing: int) -> int:
    if thing < 0:
        raise ValueError("negative")
    return thing * thing


def test_what_comes_of_things_is_in_order_with_and_without_help(monkeypatch) -> None:
    with two_processes(squared, str) as share:
        assert share(squared, [3, 1, 2, 3]) == [9, 1, 4, 9]
        assert share(str, [5]) == ["5"] and share(squared, []) == []
    monkeypatch.setattr("popsim.fitting.sharing.forked", lambda *args: None)
    with two_processes(squared) as share:
        assert share(squared, [3, 1, 2]) == [9, 1, 4]


def test_what_fails_in_either_process_is_raised_here() -> None:
    for things in ([1, -1], [-1, 1], [1, 2, 3, -1]):
        with two_processes(squared) as share:
            with pytest.raises(ValueError, match="negative"):
                share(squared, things)
            assert share(squared, [4]) == [16]


@TWO_CORES
def test_whoever_is_through_takes_the_next() -> None:
    """The second process, which has the short ones, does more of them."""
    first = os.getpid()

    def slow_here(thing: int) -> int:
        sleep(0.2 if os.getpid() == first else 0.0)
        return os.getpid()

    with two_processes(slow_here) as share:
        found = share(slow_here, range(8))
    assert 0 < found.count(first) < 4 and len(set(found)) == 2
