"""A second process works on what comes next; what comes out is the same without it."""

import os
from time import sleep

import pytest

from popsim.fitting.lookahead import Known, two_processes


def squared(thing: int) -> float:
    if thing < 0:
        raise ValueError("negative")
    return float(thing * thing)


@pytest.mark.parametrize("things", [[], [3], [3, 4], [3, 3, 4], [1, 2, 3, 2, 1, 5]])
def test_values_come_in_order_with_and_without_help(things: list[int]) -> None:
    alone, helped = (Known(squared, lambda thing: thing) for _ in range(2))
    expected = [(thing, squared(thing)) for thing in things]
    assert list(alone.ahead(things)) == expected
    with two_processes(helped):
        assert list(helped.ahead(things)) == expected


@pytest.mark.parametrize("things", [[], [3], [3, 3], [3, 4], [3, 3, 4], [1, 2, 3, 2, 1, 5]])
def test_all_values_come_in_order_with_and_without_help(things: list[int]) -> None:
    alone, helped = (Known(squared, lambda thing: thing) for _ in range(2))
    expected = [(thing, squared(thing)) for thing in things]
    assert alone.all(things) == expected
    with two_processes(helped):
        assert helped.all(things) == expected
        assert helped.all([*things, 7]) == [*expected, (7, 49.0)]


def test_whoever_stops_early_keeps_what_is_known_and_goes_on() -> None:
    value = Known(squared, lambda thing: thing)
    with two_processes(value):
        for thing, found in value.ahead([2, 3, 4]):
            assert (thing, found) == (2, 4.0)
            break
        assert list(value.ahead([5, 3])) == [(5, 25.0), (3, 9.0)]


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="there is one core only")
def test_the_second_process_takes_its_part_and_goes_away() -> None:
    asked: list[int] = []

    def noted(thing: int) -> float:
        asked.append(thing)
        return float(thing)

    value = Known(noted, lambda thing: thing)
    with two_processes(value):
        list(value.ahead(range(6)))
    assert asked == [0, 2, 4]
    list(value.ahead([9, 8]))
    assert asked == [0, 2, 4, 9, 8]


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="there is one core only")
def test_whoever_is_through_takes_the_next() -> None:
    """The second process, which has the short ones, does more of them."""
    first, done = os.getpid(), []

    def slow_here(thing: int) -> int:
        done.append(thing)
        sleep(0.2 if os.getpid() == first else 0.0)
        return os.getpid()

    value = Known(slow_here, lambda thing: thing)
    with two_processes(value):
        found = [process for _, process in value.all(range(8))]
    assert len(done) < 4 and found.count(first) == len(done)


def test_a_climb_may_ask_for_values_while_the_second_process_climbs() -> None:
    value = Known(squared, lambda thing: thing)
    climb = Known(lambda thing: sum(found for _, found in value.ahead(range(thing))), lambda thing: thing)
    with two_processes(value, climb):
        assert climb.all([4, 5, 6]) == [(4, 14.0), (5, 30.0), (6, 55.0)]


def test_what_goes_wrong_beside_is_raised_here() -> None:
    value = Known(squared, lambda thing: thing)
    with two_processes(value), pytest.raises(ValueError, match="negative"):
        list(value.ahead([1, -1]))
    with two_processes(value), pytest.raises(ValueError, match="negative"):
        value.all([2, -2, 3])
