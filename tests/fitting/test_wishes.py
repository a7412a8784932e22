"""The user's hand in fitting: what is kept stays, what is forbidden does not come."""

from dataclasses import replace

import numpy as np
import pytest
from fitting_surfaces import block, roof, subject_of, surface

from popsim.errors import InputError
from popsim.fitting import Fit, FitSettings, Pin, Region, Subject, Wishes, fit, measure_volume
from popsim.pipeline.wishes import parse_wishes

END_PAIRS = "[[0, 0, 30, -1], [40, 0, 30, 1]]"
PARAMETERS = f"{{half_width: 20, tops: [[0, 40, 30]], end_pairs: {END_PAIRS}}}"
KEEP = f"{{id: M1, type: box-fold, base: [G, B], parameters: {PARAMETERS}}}"
CELLS = 36
"""Half as many as usual: these tests ask what is chosen, not how well it fits."""


@pytest.fixture(scope="module")
def house() -> Subject:
    walls = block((-50.0, -25.0, 0.0), (50.0, 25.0, 40.0))
    subject = subject_of(surface(walls, roof((-50.0, -25.0, 40.0), (50.0, 25.0, 65.0))))
    return replace(subject, volume=measure_volume(subject.scene, subject.bounds, CELLS))


@pytest.fixture(scope="module")
def free_fit(house: Subject) -> Fit:
    return fit(house)


def wishing(**wishes: object) -> FitSettings:
    return FitSettings(wishes=Wishes(**wishes))


def region(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Region:
    return Region(np.array([x, y, z]).T)


def test_without_wishes_a_house_has_a_roof_on_a_box(free_fit: Fit) -> None:
    assert {"box-fold", "tent-fold"} <= {m.type for m in free_fit.mechanisms}


@pytest.mark.parametrize("name", ["box-fold", "tent-fold"])
def test_a_forbidden_type_does_not_come(house: Subject, name: str) -> None:
    found = fit(house, wishing(forbidden=frozenset({name})))
    assert name not in {m.type for m in found.mechanisms}
    assert all(name != kind for placement in found.placements for kind, _ in placement.alternatives)


def test_nothing_reaches_into_a_forbidden_region(house: Subject, free_fit: Fit) -> None:
    free = region((10, 60), (-99, 99), (30, 99))
    found = fit(house, wishing(keep_out=(free,)))
    assert found.mechanisms
    assert not any(free.overlaps(m) for m in found.mechanisms)
    assert any(free.overlaps(m) for m in free_fit.mechanisms)


def test_a_pin_decides_what_stands_in_its_region(house: Subject) -> None:
    everywhere = region((-99, 99), (-99, 99), (-1, 99))
    found = fit(house, wishing(pins=(Pin("tent-fold", everywhere),)))
    assert {m.type for m in found.mechanisms} == {"tent-fold"}
    elsewhere = Wishes(pins=(Pin("tent-fold", region((200, 300), (-9, 9), (0, 9))),))
    (sentence,) = elsewhere.unmet(found.mechanisms)
    assert (
        sentence
        == "wish not met: nothing that could be a tent-fold was found in its region x 200..300, y -9..9, z 0..9"
    )
    assert Wishes(pins=(Pin("tent-fold", everywhere),)).unmet(found.mechanisms) == ()


def test_what_is_kept_stays_and_the_rest_grows_around_it(house: Subject) -> None:
    wishes = parse_wishes(f"size: 100\nkeep: [{KEEP}]").wishes
    found = fit(house, FitSettings(detail=0.8, wishes=wishes))
    assert found.mechanisms[0] == wishes.kept[0]
    assert len(found.mechanisms) > 1
    assert found.without([m.id for m in found.mechanisms]).mechanisms == wishes.kept


def test_nothing_is_added_where_that_is_wished(house: Subject) -> None:
    wishes = parse_wishes(f"size: 100\nadd: false\nkeep: [{KEEP}]").wishes
    assert fit(house, FitSettings(wishes=wishes)).mechanisms == wishes.kept


@pytest.mark.parametrize(
    ("keep", "settings", "words"),
    [
        ([KEEP, KEEP.replace("M1", "M2")], {}, "what is kept does not fold: .* breaks '.*' by"),
        ([KEEP.replace(END_PAIRS, "[]")], {}, "what is kept does not fold: M1 breaks"),
        ([KEEP], {"most_patches": 3}, "what is kept has 9 patches, more than the 3 allowed"),
    ],
)
def test_what_is_kept_must_fold(house: Subject, keep: list[str], settings: dict[str, int], words: str) -> None:
    wishes = parse_wishes(f"size: 100\nkeep: [{', '.join(keep)}]").wishes
    with pytest.raises(InputError, match=words):
        fit(house, FitSettings(wishes=wishes, **settings))
