"""What fitting costs with the number of points that stand for the model."""

from pathlib import Path

import pytest
from conftest import Report, cpu_seconds, exponent

from popsim.fitting import Subject, fit, measure_volume
from popsim.fitting.snap import Planes
from popsim.mesh.sampling import sample_surface, spread
from popsim.pipeline.abstract import GATHER, RANSAC_POINTS
from popsim.pipeline.prepare import Stance, prepare

POINTS = (5_000, 20_000, 80_000)


@pytest.mark.usefixtures("compiled")
def test_fitting(models: Path, report: Report) -> None:
    prepared = prepare(models / "truck" / "truck.obj", Stance(), 150.0, seed=0)
    scene = prepared.scene.opaque()
    volume = measure_volume(scene, prepared.bounds)
    rows, costs = [], []
    for count in POINTS:

        def sampled(count: int = count) -> Subject:
            samples = sample_surface(prepared.surface, count, seed=0)
            planes = Planes.of(samples.points, samples.normals, samples.area, GATHER)
            points = spread(samples, prepared.bounds, RANSAC_POINTS, 0)
            return Subject(scene, prepared.bounds, volume, planes, points)

        subject = sampled()
        sampling = cpu_seconds(sampled, rounds=1)
        fitting = cpu_seconds(lambda subject=subject: fit(subject), rounds=1)
        rows.append((count, sampling, fitting, sampling + fitting))
        costs.append(sampling + fitting)
    power = exponent(POINTS, costs)
    report(f"fitting the truck, exponent {power:.2f}", ("points", "sampling, s", "fitting, s", "both, s"), rows)
