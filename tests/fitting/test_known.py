"""What is asked again is not worked out again."""

from popsim.fitting.known import Known


def test_things_with_equal_keys_are_worked_out_once() -> None:
    done: list[int] = []

    def noted(thing: int) -> int:
        done.append(thing)
        return thing * thing

    known = Known(noted, abs)
    assert [known(thing) for thing in (2, -2, 3, 2)] == [4, 4, 9, 4]
    assert done == [2, 3]
