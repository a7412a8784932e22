"""Tolerances of the verdict."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """How much is recorded and what is allowed; lengths in mm.

    Attributes
    ----------
    angles:
        Recorded fold angles each way.
    rigid:
        Largest loop gap of a design that folds without any give.
    play:
        Largest loop gap that paper gives way to.
    flat:
        Distance from the plane of the closed card: a fifth of the usual thickness of the paper.
    reopened:
        Distance of any corner from its first place after closing and opening; other branches are off by
        millimetres.
    crossing:
        How far one patch may reach through another beyond the loop gap, by which all is displaced: touching is no
        crossing.
    first_contact:
        Degrees; how exactly the fold angle is told at which patches begin to cross.
    protruding:
        How far anything may stick out of the closed card: half the usual thickness of the paper.
    pose:
        Distance of any corner from its closed form between 179 and 1 degree, where loops close rigidly.
    closing_range:
        Difference between measured and analytic closing range.
    pushed:
        Motion under a small wrench on every patch, and what is left of it after release, of the size of the
        pop-up; the wrench carries a free plate sixty times as far.
    """

    angles: int = 180
    rigid: float = 0.001
    play: float = 0.3
    flat: float = 0.05
    reopened: float = 0.05
    crossing: float = 0.05
    first_contact: float = 0.01
    protruding: float = 0.1
    pose: float = 0.001
    closing_range: float = 0.01
    pushed: float = 5e-3
