"""Fitting of a prepared model."""

from popsim.fitting import Fit, FitSettings, Subject, fit, measure_volume
from popsim.fitting.snap import Planes
from popsim.pipeline.prepare import Prepared

POINTS = 20_000
"""Pseudo vertices that tell where the model's planes lie."""

GATHER = 0.5
"""mm; surface within this counts as one plane."""


def abstract(prepared: Prepared, settings: FitSettings, seed: int) -> Fit:
    """Abstract a prepared model into prisms and mechanisms.

    Raises
    ------
    MeshError
        Nothing of it is solid enough.
    """
    from popsim.mesh.sampling import sample_surface

    scene = prepared.scene.opaque()
    volume = measure_volume(scene, prepared.bounds)
    samples = sample_surface(prepared.surface, POINTS, seed=seed)
    planes = Planes.of(samples.points, samples.normals, samples.area, GATHER)
    return fit(Subject(scene, prepared.bounds, volume, planes), settings)
