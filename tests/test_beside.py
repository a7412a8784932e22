"""Work in a second process gives what it gives in the first."""

import os

import pytest

from popsim.beside import Beside
from popsim.errors import InputError

TWO_CORES = hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1


def test_the_result_comes_back() -> None:
    numbers = [1, 2, 3]
    assert Beside(lambda: sum(numbers)).result() == 6


@pytest.mark.skipif(not TWO_CORES, reason="there is one core only")
def test_it_is_worked_out_elsewhere() -> None:
    assert Beside(os.getpid).result() != os.getpid()


def test_what_goes_wrong_is_raised_where_the_result_is_asked_for() -> None:
    def fail() -> None:
        raise InputError("no good")

    started = Beside(fail)
    with pytest.raises(InputError, match="no good"):
        started.result()


def test_with_one_core_it_is_done_when_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda who: {0}, raising=False)
    assert Beside(os.getpid).result() == os.getpid()


def test_a_process_that_dies_does_not_take_the_result_along() -> None:
    first = os.getpid()
    assert Beside(lambda: os.getpid() if os.getpid() == first else os._exit(3)).result() == first
