"""Sets as masks: the same as sets."""

from hypothesis import given
from hypothesis import strategies as st

from popsim.assembly.roll import Roll, groups, places, spread

NAMES = "abcdefgh"
PAIRS = st.lists(st.tuples(st.sampled_from(NAMES), st.sampled_from(NAMES)))


@given(st.sets(st.sampled_from(NAMES)))
def test_masks_tell_the_names_again(names: set[str]) -> None:
    roll = Roll(NAMES)
    assert roll.names(roll.mask(names)) == names
    assert [NAMES[k] for k in places(roll.mask(names))] == sorted(names)


@given(PAIRS, st.sets(st.sampled_from(NAMES)))
def test_groups_are_what_is_reached_and_together_all(pairs: list[tuple[str, str]], names: set[str]) -> None:
    roll = Roll(NAMES)
    near = roll.relation(pairs + [(b, a) for a, b in pairs])
    among = roll.mask(names)
    found = groups(among, near)
    assert sum(found) == among
    home = {name: k for k, group in enumerate(found) for name in roll.names(group)}
    assert all(home[a] == home[b] for a, b in pairs if a in names and b in names)
    assert all(spread(1 << k, near, among) == group for group in found for k in places(group))


def test_what_is_not_among_stops_the_spread() -> None:
    roll = Roll("abc")
    near = roll.relation([("a", "b"), ("b", "c")])
    assert roll.names(spread(roll.mask("a"), near, roll.mask("abc"))) == set("abc")
    assert roll.names(spread(roll.mask("a"), near, roll.mask("ac"))) == {"a"}
