"""Models that look the same along all axes are told from others."""

import numpy as np
import pytest
from fitting_surfaces import block, quarter_turned, subject_of, surface

from popsim.fitting import fit_best
from popsim.fitting.fronts import Fronts
from popsim.fitting.outset import Outset
from popsim.rendering.ray_scene import RayScene

BOUNDS = np.array([[-30.0, -30.0, 0.0], [30.0, 30.0, 40.0]])
TIERS = (block((-30, -30, 0), (30, 30, 22)), block((-18, -18, 20), (18, 18, 40)))
HALF = block((-30, -30, 20), (30, 0, 40))


def fronts(*parts, bounds=BOUNDS) -> Fronts:
    return Fronts.of(RayScene(surface(*parts)), bounds, 0.7)


def test_what_is_square_looks_the_same_over_both_folds_and_what_is_not_does_not():
    assert fronts(*TIERS).same_as(fronts(*map(quarter_turned, TIERS)))
    assert not fronts(*TIERS, HALF).same_as(fronts(*map(quarter_turned, (*TIERS, HALF))))


@pytest.mark.parametrize("bounds", [BOUNDS + np.array([0.0, 0.1, 0.0]), 1.5 * BOUNDS])
def test_what_is_looked_at_elsewhere_is_not_the_same(bounds):
    assert not fronts(*TIERS).same_as(fronts(*TIERS, bounds=bounds))


@pytest.mark.parametrize(("parts", "folds"), [(TIERS, {0}), ((*TIERS, HALF), {0, 1})])
def test_a_fold_over_which_the_model_looks_as_over_another_is_not_searched(parts, folds, monkeypatch):
    subjects = [subject_of(surface(*parts)), subject_of(surface(*map(quarter_turned, parts)))]
    searched, begun = [], Outset.begun

    def watched(outset, manner):
        searched.append(outset.subject)
        return begun(outset, manner)

    monkeypatch.setattr(Outset, "begun", watched)
    monkeypatch.setattr("popsim.beside._forked", lambda works: None)
    fit_best(subjects)
    assert {subjects.index(subject) for subject in searched} == folds
