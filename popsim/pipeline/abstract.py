"""Fitting of a prepared model."""

from popsim.fitting import Fit, FitSettings, Subject, fit, measure_volume
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
    from popsim.mesh.sampling import sample_surface, spread

    scene = prepared.scene.opaque()
    volume = measure_volume(scene, prepared.bounds)
    samples = sample_surface(prepared.surface, POINTS, seed=seed)
    planes = Planes.of(samples.points, samples.normals, samples.area, GATHER)
    chosen = spread(samples, prepared.bounds, RANSAC_POINTS, seed)
    return fit(Subject(scene, prepared.bounds, volume, planes, chosen, seed), settings)
