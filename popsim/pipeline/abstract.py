"""Fitting, with a retry for models that are mostly air."""

from dataclasses import dataclass

from popsim.errors import MeshError
from popsim.fitting import Fit, FitSettings, Subject, fit, measure_volume
from popsim.fitting.snap import Planes
from popsim.pipeline.prepare import Prepared

POINTS = 20_000
"""Pseudo vertices that tell where the model's planes lie."""

GATHER = 0.5
"""mm; surface within this counts as one plane."""

CLOSINGS = (0, 4, 8)
"""Cells by which gaps are closed, in turn, until something solid enough for a mechanism is found."""


@dataclass(frozen=True)
class Abstraction:
    """A fit and what had to be assumed for it."""

    fit: Fit
    notes: tuple[str, ...]


def abstract(prepared: Prepared, settings: FitSettings, seed: int) -> Abstraction:
    """Abstract a prepared model into prisms and mechanisms.

    Raises
    ------
    MeshError
        Nothing of it is solid enough.
    """
    from popsim.mesh.sampling import sample_surface
    from popsim.rendering.ray_scene import RayScene

    scene = RayScene(prepared.surface.bare())
    volume = measure_volume(scene, prepared.bounds)
    samples = sample_surface(prepared.surface, POINTS, seed=seed)
    planes = Planes.of(samples.points, samples.normals, samples.area, GATHER)
    for radius in CLOSINGS:
        try:
            filled = volume.closed(radius) if radius else volume
            found = fit(Subject(scene, prepared.bounds, filled, planes), settings)
        except MeshError:
            if radius == CLOSINGS[-1]:
                raise
            continue
        gap = 2 * radius * volume.cell
        note = f"the model is mostly air: gaps of up to {gap:.0f} mm were taken as solid to find its shape"
        return Abstraction(found, (note,) if radius else ())
    raise AssertionError("unreachable")
