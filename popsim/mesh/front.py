"""Which end of the fold is the front: the custom of the file format weighed against the shape.

Both speak in logarithms of odds, as for the up axis. A format that defines the front (glTF 2.0, 3.4: the front
faces +z where +y is up) says so with its prior weight (:mod:`popsim.mesh.formats`). The shape says less. Of 48
models whose front is known 30 have a lower end: it is the front of 21, vehicles and seats most of all, and the
back of nine, animals among them. Of the others that have an end with less surface it is the front of half.

The custom counts where the model lies in its file as the format has it. It fades as the up axis, and the line from
front to back, turn away from those of the format, and says nothing from 45 degrees on: nothing of
the ends of a model that is built along the other horizontal axis, and nothing of one that lies on its side, which
then stands as its shape alone has it. What is turned in its file by less keeps part of the custom. What is turned
to stand backwards, by 180 degrees about its up axis, breaks the rule of its format: nothing in the file tells, and
it is believed. Where the ends are those of the sides of a house, and alike, the custom says which of its faces
shall look at the viewer, from the ground page.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from popsim.geometry.arrays import FloatArray, locked
from popsim.mesh.formats import FRONT_AXIS, FRONT_UP_AXIS, NO_CUSTOM
from popsim.mesh.level import Level, lean

LEAN = 0.004
"""Moments (relative to the extents) below this are noise, and the front cannot be told by them."""
LOW_WEIGHT, LESS_WEIGHT = 40.0, 5.0
"""Log odds per unit of the moment by which one end is lower (fitted to those models), and by which it has less
surface (a little: alone it is right as often as wrong, beside the other moment it weighs 9)."""


@dataclass(frozen=True, eq=False)
class FrontChoice:
    """The direction that is taken to be the front.

    Attributes
    ----------
    direction:
        Horizontal unit vector in the level frame, shape (3,).
    confidence:
        0..1, against the opposite direction; 1 where the user said so.
    reason:
        One sentence.
    """

    direction: FloatArray
    confidence: float
    reason: str

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", locked(self.direction, (3,), "front direction"))


class _Look(NamedTuple):
    """Which end looks like the front.

    `sign` is +1 or -1 along the axis, `odds` the log odds of it, `words` a sentence, and `end` what it is called,
    empty where both ends look alike.
    """

    sign: float
    odds: float
    words: str
    end: str


def stated_front(axis: FloatArray, front: FloatArray, word: str) -> FrontChoice:
    """Return `axis` or its opposite, whichever is nearer to the `front` that the user states as `word`."""
    return FrontChoice(axis * (1.0 if axis @ front > 0 else -1.0), 1.0, f"{word} is the front, as told")


def choose_front(level: Level, axis: FloatArray, custom: float) -> FrontChoice:
    """Choose between the two ends of a horizontal axis.

    Parameters
    ----------
    level:
        The model, upright.
    axis:
        Unit vector in the level frame, shape (3,).
    custom:
        Prior weight of +z as the front, 0..1, by the format (:attr:`popsim.mesh.formats.ModelFormat.front`).
    """
    look = _looks(level, axis)
    if custom == NO_CUSTOM:
        return FrontChoice(axis * look.sign, _share(look.odds), look.words)
    front = level.rotation[:, "xyz".index(FRONT_AXIS)]
    ahead, aside = float(axis @ front), float(np.cross([0.0, 0.0, 1.0], axis) @ front)
    upright = float(level.rotation[2]["xyz".index(FRONT_UP_AXIS)])
    towards = 1.0 if ahead > 0 else -1.0
    trust = _trust(upright) * _trust(abs(ahead))
    facing = _trust(upright) * _trust(abs(aside))
    if facing and not look.end:
        weight = NO_CUSTOM + (custom - NO_CUSTOM) * facing
        words = f"both ends look alike; the side towards {FRONT_AXIS} is the front, as is usual for the format"
        return FrontChoice(axis * (1.0 if aside > 0 else -1.0), weight, words)
    if trust == 0:
        return FrontChoice(axis * look.sign, _share(look.odds), f"{look.words}; {_silence(upright)}")
    weight = NO_CUSTOM + (custom - NO_CUSTOM) * trust
    odds = look.sign * look.odds + towards * float(np.log(weight / (1 - weight)))
    sign = 1.0 if odds > 0 else -1.0
    return FrontChoice(axis * sign, _share(abs(odds)), _reason(look, sign, towards))


def _share(odds: float) -> float:
    """Return the probability that has these log odds."""
    return float(1 / (1 + np.exp(-odds)))


def _trust(cosine: float) -> float:
    """Return how far a custom is trusted, 0..1, by the cosine to its axis: half at 22 degrees, not from 45 on."""
    return max(0.0, 2 * cosine * abs(cosine) - 1) ** 2


def _silence(upright: float) -> str:
    if _trust(upright) == 0:
        return f"where {FRONT_UP_AXIS} is not up, the format does not tell"
    return f"{FRONT_AXIS}, the usual front of the format, is neither end"


def _reason(look: _Look, sign: float, towards: float) -> str:
    if sign != towards:
        return f"{look.words}, although {FRONT_AXIS} is usual for the format"
    if not look.end:
        return f"both ends look alike; the one towards {FRONT_AXIS} is the front, as is usual for the format"
    if sign == look.sign:
        return f"{look.words}; it is towards {FRONT_AXIS}, as is usual for the format"
    usual = f"the end towards {FRONT_AXIS} is the front, as is usual for the format"
    return f"{usual}, although {look.end} is the other"


def _looks(level: Level, axis: FloatArray) -> _Look:
    """Tell the front by the lower end, then by the end with less surface, then by the model's own axes."""
    samples = level.samples
    weight = samples.area / samples.area.sum()
    along, height = _centred(samples.points @ axis), _centred(samples.points[:, 2])
    for moment, scale, end in (
        (float(weight @ (along * (height - weight @ height))), LOW_WEIGHT, "the lower end"),
        (float(weight @ along), LESS_WEIGHT, "the end with less surface"),
    ):
        if abs(moment) > LEAN:
            return _Look(-float(np.sign(moment)), scale * abs(moment), f"{end} is the front", end)
    if (exact := lean(level.surface, axis)) != 0:
        words = "both ends look alike; the one with a little less surface is the front"
        return _Look(-float(np.sign(exact)), LESS_WEIGHT * abs(exact), words, "")
    own = axis @ level.rotation
    sign = float(np.sign(own[np.abs(own).argmax()]))
    return _Look(sign, 0.0, "both ends look alike; the front follows the model's axes", "")


def _centred(values: FloatArray) -> FloatArray:
    """Scale values to -0.5..0.5."""
    low, high = values.min(), values.max()
    return np.asarray((values - (low + high) / 2) / max(float(high - low), 1e-300))
