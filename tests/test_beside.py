"""A second process takes its share of work; what comes out is the same without it."""

import os
from time import sleep

import pytest

from popsim.beside import begun, two_processes

TWO_CORES = pytest.mark.skipif(
    not hasattr(os, "sched_getaffinity") or len(os.sched_getaffinity(0)) < 2, reason="there is one core only"
)


@pytest.fixture(params=["one core", "two cores"])
def cores(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if request.param == "one core":
        monkeypatch.setattr(os, "sched_getaffinity", lambda who: {0}, raising=False)


def squared(thing: int) -> int:
    if thing < 0:
        raise ValueError("negative")
    return thing * thing


def process(thing: float) -> int:
    sleep(thing)
    return os.getpid()


@pytest.mark.usefixtures("cores")
def test_what_comes_of_things_is_in_order_with_and_without_help() -> None:
    assert begun(squared, [3, 1, 2, 3])() == [9, 1, 4, 9]
    assert begun(squared, [3])() == [9] and begun(squared, [])() == []
    with two_processes(squared, str) as share:
        assert share(squared, [3, 1, 2, 3]) == [9, 1, 4, 9]
        assert share(str, [5]) == ["5"] and share(squared, []) == []


@pytest.mark.usefixtures("cores")
def test_what_fails_in_either_process_is_raised_where_it_is_asked_for() -> None:
    for things in ([1, -1], [-1, 1], [1, 2, 3, -1]):
        started = begun(squared, things)
        with pytest.raises(ValueError, match="negative"):
            started()
        with two_processes(squared) as share:
            with pytest.raises(ValueError, match="negative"):
                share(squared, things)
            assert share(squared, [4, 5]) == [16, 25]


def test_things_and_works_that_cannot_be_sent_are_no_matter_for_what_is_begun_once() -> None:
    assert begun(lambda thing: thing(), [lambda: 1, lambda: 2])() == [1, 2]


def test_with_one_core_it_is_done_when_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda who: {0}, raising=False)
    assert begun(process, [0.0, 0.0])() == 2 * [os.getpid()]


@TWO_CORES
def test_it_is_begun_before_anybody_asks() -> None:
    started = begun(process, [0.0, 0.0])
    sleep(1.0)
    assert os.getpid() not in started()


@TWO_CORES
def test_whoever_is_through_takes_the_next() -> None:
    """The second process, which has the short ones, does more of them."""
    first = os.getpid()

    def slow_here(thing: int) -> int:
        return process(0.2 if os.getpid() == first else 0.0)

    with two_processes(slow_here) as share:
        found = share(slow_here, range(8))
    assert 0 < found.count(first) < 4 and len(set(found)) == 2


@TWO_CORES
def test_a_process_that_dies_does_not_take_the_results_along() -> None:
    first = os.getpid()

    def deadly(thing: int) -> int:
        return thing if os.getpid() == first else os._exit(3)

    assert begun(deadly, [1, 2, 3])() == [1, 2, 3]
    with two_processes(deadly) as share:
        assert share(deadly, [1, 2, 3]) == share(deadly, [1, 2, 3]) == [1, 2, 3]


def test_one_may_be_begun_beside_another_and_end_first() -> None:
    first, second = begun(squared, [1, 2]), begun(squared, [3, 4])
    assert first() == [1, 4] and second() == [9, 16]


@TWO_CORES
def test_a_second_process_does_alone_what_is_begun_within() -> None:
    def nested(thing: int) -> tuple[list[int], int]:
        return begun(squared, [thing, thing + 1])(), os.getpid()

    started = begun(nested, [1, 2])
    sleep(1.0)
    (first, one), (second, other) = started()
    assert (first, second) == ([1, 4], [4, 9]) and one == other != os.getpid()
