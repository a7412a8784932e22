"""Fitting of a prepared model."""

from collections.abc import Sequence

from popsim.fitting import Fit, FitSettings, Subject, fit, fit_best, measure_volume
from popsim.fitting.snap import Planes
from popsim.pipeline.prepare import Prepared

POINTS = 10_000
"""Pseudo vertices that tell where the model's planes lie."""

RANSAC_POINTS = 1000
"""How many of them RANSAC fits prisms to."""

GATHER = 0.5
"""mm; surface within this counts as one plane."""


def abstract(prepared: Prepared, settings: FitSettings, seed: int) -> Fit:
    """Abstract a prepared model into prisms and mechanisms.

    Raises
    ------
    MeshError
        Nothing of it is solid enough.
    """
    return fit(subject_of(prepared, seed), settings)


def abstract_best(ways: Sequence[Prepared], settings: FitSettings, seed: int) -> tuple[Prepared, Fit]:
    """The same for a model that may stand over the fold in several ways: the way that shows most of it."""
    number, found = fit_best([subject_of(way, seed) for way in ways], settings)
    return ways[number], found


def subject_of(prepared: Prepared, seed: int) -> Subject:
    """What is to be abstracted of a prepared model."""
    from popsim.mesh.sampling import sample_surface, spread

    scene = prepared.scene.opaque()
    volume = measure_volume(scene, prepared.bounds)
    samples = sample_surface(prepared.surface, POINTS, seed=seed)
    planes = Planes.of(samples.points, samples.normals, samples.area, GATHER)
    chosen = spread(samples, prepared.bounds, RANSAC_POINTS, seed)
    return Subject(scene, prepared.bounds, volume, planes, chosen, seed)
