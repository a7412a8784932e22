"""A second process works on what comes next; what comes out is the same without it."""

import os

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


def test_what_goes_wrong_beside_is_raised_here() -> None:
    value = Known(squared, lambda thing: thing)
    with two_processes(value), pytest.raises(ValueError, match="negative"):
        list(value.ahead([1, -1]))
