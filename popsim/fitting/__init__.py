"""Abstraction of a model into prisms on base patch pairs, and their mapping to mechanisms (Sec. 4.1, 4.2).

The model is read as a volume: a cell of space is *solid* unless it is seen from outside along an axis, which
needs neither closed nor clean meshes. Prisms are then placed one after another, each where it gains most: solid
cells it covers, less empty cells it covers, less a price for each patch. A prism stands on a base patch pair that
an earlier one offers, so that constraints 1 to 3 hold by construction, and it is accepted only if the whole
design still meets every condition of :mod:`popsim.validity`.

There are three ways to begin: profiles of most gain (:mod:`popsim.fitting.rows`), the same with steps and tops
only where the views of the model fall into layers (Eq. 3, :mod:`popsim.fitting.layers`), and prisms that RANSAC
fits to points of its surface (Eq. 1, :mod:`popsim.fitting.ransac`). What looks most like the model is refitted
(:mod:`popsim.fitting.refit`), and the report says how it was begun.
"""

from popsim.fitting.fit import Fit, fit, fit_best
from popsim.fitting.ransac import Weights
from popsim.fitting.settings import FitSettings
from popsim.fitting.subject import Subject
from popsim.fitting.volume import Volume, measure_volume
from popsim.fitting.wishes import Pin, Region, Wishes

__all__ = [
    "Fit",
    "FitSettings",
    "Pin",
    "Region",
    "Subject",
    "Volume",
    "Weights",
    "Wishes",
    "fit",
    "fit_best",
    "measure_volume",
]
