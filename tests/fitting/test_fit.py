"""Models whose abstraction is known."""

import numpy as np
import pytest
from fitting_surfaces import block, quarter_turned, roof, subdivided, subject_of, surface

from popsim.design import Card
from popsim.errors import InputError
from popsim.fitting import Fit, FitSettings, fit, fit_best
from popsim.fitting.corners import propose_corner
from popsim.fitting.field import Field, spot_on
from popsim.fitting.mapping import error_cover, mappings
from popsim.geometry.surface import Surface
from popsim.mechanisms import RectangularPrism, assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.validity import examine

PAIR = card_pair(Card(x=(-500.0, 500.0), depth=500.0))


def fitted(shape: Surface, **settings: float) -> Fit:
    return fit(subject_of(shape), FitSettings(**settings))


def types(found: Fit) -> list[tuple[str, tuple[str, str]]]:
    return [(p.mechanism.type, p.mechanism.pair.patches) for p in found.placements]


def test_block_becomes_one_box_of_exactly_its_size() -> None:
    found = fitted(surface(block((-48.3, -20.7, 0), (48.3, 20.7, 31.9))))
    assert types(found) == [("box-fold", ("G", "B"))]
    box = found.mechanisms[0]
    assert isinstance(box, BoxFold)
    assert box.half_width == pytest.approx(20.7, abs=1e-6)
    assert box.x == pytest.approx((-48.3, 48.3), abs=1e-6)
    assert box.height == pytest.approx(31.9, abs=1e-6)
    assert found.likeness.silhouette > 0.98 and found.likeness.relief > 0.97


def test_tessellation_does_not_matter() -> None:
    coarse = block((-48.3, -20.7, 0), (48.3, 20.7, 31.9))
    one, two = fitted(surface(coarse)), fitted(surface(subdivided(coarse, 4)))
    assert one.mechanisms[0].parameters() == two.mechanisms[0].parameters()


def test_pickup_becomes_one_box_with_layers() -> None:
    found = fitted(surface(block((-48, -20, 0), (48, 20, 20)), block((-10, -20, 20), (20, 20, 40))))
    assert types(found) == [("box-fold", ("G", "B"))]
    assert [round(top.height) for top in found.mechanisms[0].tops] == [20, 40, 20]


def test_tower_on_a_plinth_becomes_a_box_on_a_box() -> None:
    found = fitted(surface(block((-48, -40, 0), (48, 40, 30)), block((-20, -15, 30), (20, 15, 80))))
    assert types(found) == [("box-fold", ("G", "B")), ("box-fold", ("M1.T_G", "M1.T_B"))]


def test_of_two_folds_that_is_taken_over_which_more_shows() -> None:
    steps = [block((-48, -15, 0), (0, 15, 20)), block((0, -15, 0), (48, 15, 40))]
    along, across = (subject_of(surface(*shape)) for shape in (steps, [quarter_turned(step) for step in steps]))
    for subjects, better in (((along, across), 0), ((across, along), 1)):
        number, found = fit_best(subjects)
        assert number == better
        assert [round(top.height) for top in found.mechanisms[0].tops] == [20, 40]


def test_gable_roof_becomes_a_tent_on_a_box() -> None:
    found = fitted(surface(block((-48, -25, 0), (48, 25, 30)), roof((-48, -25, 30), (48, 25, 55))))
    assert types(found) == [("box-fold", ("G", "B")), ("tent-fold", ("M1.T_G", "M1.T_B"))]


def test_annex_on_one_side_becomes_a_step_there() -> None:
    found = fitted(surface(block((-48, -20, 0), (48, 20, 60)), block((-40, 20, 0), (40, 38, 25))))
    assert types(found) == [("box-fold", ("G", "B")), ("step-fold", ("G", "M1.L"))]


def ring(inner: float, outer: float, half: float, count: int = 48) -> np.ndarray:
    """A ring that stands on its edge, its axis across the fold."""
    turns = np.linspace(0, 2 * np.pi, count + 1)
    way = np.stack([np.cos(turns), 0 * turns, np.sin(turns)], axis=1)
    up, aside = np.array([0, 0, outer]), np.array([0, half, 0])
    lines = [r * way + up + s * aside for r, s in ((inner, 1), (outer, 1), (outer, -1), (inner, -1))]
    faces = []
    for first, second in zip(lines, lines[1:] + lines[:1], strict=True):
        faces += [np.stack([first[:-1], first[1:], second[1:]], axis=1)]
        faces += [np.stack([first[:-1], second[1:], second[:-1]], axis=1)]
    return np.concatenate(faces)


def test_ring_on_its_edge_becomes_one_box_that_is_seen_through() -> None:
    found = fitted(surface(ring(44, 50, 6)))
    assert types(found) == [("box-fold", ("G", "B"))]
    assert found.likeness.silhouette > 0.8


def test_bay_is_found_beside_a_wall_that_ends_within_a_cell() -> None:
    subject = subject_of(surface(block((-48, -20, 0), (48, 20, 60)), block((-12, 20, 20), (12, 38, 50))))
    box = BoxFold.plain("M1", PAIR, 19.2, 60, (-48, 48))
    field = Field(subject.volume, 0.3)
    field.cover(box.primitive())
    corner = next(pair for pair in box.pairs() if pair.patches == ("G", "M1.L"))
    spot = spot_on(field, corner)
    assert spot is not None
    found = propose_corner(spot)
    assert found is not None and isinstance(found.primitive, RectangularPrism)
    assert found.primitive.low == pytest.approx((-12, 19.2, 0), abs=1.4)
    assert found.primitive.high == pytest.approx((12, 38, 50), abs=1.4)


def test_detail_brings_patches() -> None:
    tiers = [block((-48 + 8 * k, -40 + 6 * k, 0), (48 - 8 * k, 40 - 6 * k, 12.0 * (k + 1))) for k in range(5)]
    found = [fitted(surface(*tiers), detail=detail).mechanisms for detail in (0.1, 0.5, 0.8)]
    counts = [sum(len(mechanism.plates()) for mechanism in mechanisms) for mechanisms in found]
    assert counts[0] < min(counts[1:])


def test_every_fit_meets_the_theory() -> None:
    rng = np.random.default_rng(7)
    for _ in range(3):
        parts = []
        for _ in range(4):
            low = rng.uniform((-48, -30, 0), (10, 0, 0))
            parts.append(block(tuple(low), tuple(low + rng.uniform((20, 10, 10), (38, 30, 50)))))
        found = fitted(surface(*parts), detail=0.8)
        design = assemble(Card(x=(-900, 900), depth=900), found.mechanisms)
        assert examine(design).holds


def test_error_cover_of_a_plain_box_is_its_bottom() -> None:
    prism = RectangularPrism((-30.0, -20.0, 0.0), (30.0, 20.0, 50.0))
    mapped = mappings(prism, PAIR, "M1")
    assert [m.mechanism.type for m in mapped] == ["box-fold"]
    total = 2 * (60 * 40 + 60 * 50 + 40 * 50)
    assert error_cover(mapped[0].mechanism, prism) == pytest.approx(60 * 40 / total)


def test_settings_out_of_range_are_refused() -> None:
    with pytest.raises(InputError, match="detail"):
        FitSettings(detail=1.5)
    with pytest.raises(InputError, match="patches"):
        FitSettings(most_patches=1)


def test_fit_at_another_size_is_the_same_shape() -> None:
    found = fitted(surface(block((-48, -40, 0), (48, 40, 30)), block((-20, -15, 30), (20, 15, 80))))
    small = found.scaled(0.4)
    assert types(small) == types(found)
    for one, other in zip(found.mechanisms, small.mechanisms, strict=True):
        for plate, reduced in zip(one.plates(), other.plates(), strict=True):
            np.testing.assert_allclose(reduced.outline, 0.4 * plate.outline, atol=1e-9)


def wedge(tip: float, depth: float, height: float) -> np.ndarray:
    """An upright wedge that points to +x at 45 degrees to both sides."""
    corners = [(tip, 0.0), (tip - depth, depth), (tip - depth, -depth)]
    low, high = (np.array([[x, y, z] for x, y in corners]) for z in (0.0, height))
    faces = [low[::-1], high]
    for k in range(3):
        m = (k + 1) % 3
        faces += [[low[k], low[m], high[m]], [low[k], high[m], high[k]]]
    return np.array(faces)


def test_wedge_becomes_a_v_fold_that_faces_its_tip() -> None:
    found = fitted(surface(wedge(40.0, 40.0, 50.0)))
    assert types(found)[0] == ("v-fold-2", ("G", "B"))
    fold = found.mechanisms[0]
    assert fold.facing == 1
    assert fold.tip == pytest.approx(40.0, abs=3.0)
    assert fold.width == pytest.approx(40.0 * np.sqrt(2), abs=5.0)


def test_box_on_its_corner_becomes_the_whole_v_fold() -> None:
    both = np.concatenate([wedge(40.0, 40.0, 50.0), wedge(40.0, 40.0, 50.0) * [-1, 1, 1]])
    found = fitted(surface(both))
    assert types(found)[0] == ("v-fold-1", ("G", "B"))
