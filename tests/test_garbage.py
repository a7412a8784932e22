"""Python looks seldom for garbage for a while, and as before afterwards."""

import gc

import pytest

from popsim.garbage import SELDOM, seldom_collected


def test_what_was_set_before_is_set_again() -> None:
    before = gc.get_threshold()
    with pytest.raises(ValueError, match="stop"), seldom_collected():
        assert gc.get_threshold() == (SELDOM, *before[1:])
        raise ValueError("stop")
    assert gc.get_threshold() == before and gc.get_freeze_count() == 0
