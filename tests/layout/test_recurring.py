"""What recurs from plan to plan is the same object, and what is known of it is not searched for again."""

import pytest
import shapely

from popsim.design import Design
from popsim.layout import nets as nets_module
from popsim.layout.divisions import parts_of
from popsim.layout.joints import find_joints
from popsim.layout.nets import find_nets
from popsim.layout.recurring import Recurring

ROOM = (194.0, 263.0)


def test_the_same_parts_and_joints_are_found_again(box: Design) -> None:
    recurring = Recurring()
    first = recurring.parts(parts_of(box, ()))
    joints = recurring.joints(find_joints(box, first))
    assert all(a is b for a, b in zip(recurring.parts(parts_of(box, ())), first, strict=True))
    assert all(a is b for a, b in zip(recurring.joints(find_joints(box, first)), joints, strict=True))


def test_other_parts_and_joints_are_others(box: Design) -> None:
    """The ground in two has parts and joints of its own; all else stays."""
    recurring = Recurring()
    first = recurring.parts(parts_of(box, ()))
    joints = recurring.joints(find_joints(box, first))
    ground = next(part for part in first if part.id == "G").polygon
    low_u, low_v, high_u, high_v = ground.bounds
    middle = (low_u + high_u) / 2
    halves = tuple(
        ground & shapely.box(*ends) for ends in ((low_u, low_v, middle, high_v), (middle, low_v, high_u, high_v))
    )
    second = recurring.parts(parts_of(box, [{"G": halves}]))
    others = recurring.joints(find_joints(box, second))
    assert {part.id for part in set(second) - set(first)} == {"G/1", "G/2"}
    assert all({"G/1", "G/2"} & set(joint.parts) for joint in set(others) - set(joints))
    assert set(others) & set(joints)


def test_nets_of_the_same_parts_are_searched_once(box: Design, monkeypatch: pytest.MonkeyPatch) -> None:
    """Barring a fold of one group leaves the other groups as they are; grown anew are only its own."""
    parts = parts_of(box, ())
    joints = find_joints(box, parts)
    grown: list[set[str]] = []
    original = nets_module._grow  # what is asked for again cannot be seen from outside

    def counted(own: object, *rest: object) -> object:
        grown.append({part.id for part in own})
        return original(own, *rest)

    monkeypatch.setattr(nets_module, "_grow", counted)
    before = find_nets(parts, joints, ROOM, 10.0)
    grown.clear()
    again = find_nets(parts, joints, ROOM, 10.0)
    assert not grown
    assert all(a is b for a, b in zip(before, again, strict=True))
    opened = next(net for net in before if net.folds)
    fewer = find_nets(parts, joints, ROOM, 10.0, frozenset({opened.folds[0].id}))
    assert grown
    assert sum(len(net.folds) for net in fewer) < sum(len(net.folds) for net in before)
