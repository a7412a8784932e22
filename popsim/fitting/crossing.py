"""Of two plates that would both reach beyond their common hinge one will end there.

Contours are cut so (:mod:`popsim.patches.crossing`), stretch by stretch of the hinge; here cell by cell.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from popsim.fitting.stencil import Stencil
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import Plate
from popsim.stock import MAY_CROSS, RISEN_WORTH

STRAIGHT = 1e-6
"""mm; hinges that leave the rows and columns of the cells by more are left alone."""

Band = tuple[int, int, int, int, bool]
"""Cells beyond a stretch of a hinge: the axis that runs along it, first and last place (exclusive) along that, the
border that it lies on, and whether the face lies above that."""


class Overhang(NamedTuple):
    """What a plate shows beyond one of its hinges.

    Attributes
    ----------
    line:
        Ends of the hinge, mm, the lesser first, shape (2, 3) as bytes: the same for both plates.
    length:
        Of the hinge, mm.
    touched:
        In which places along it something shows that goes on beyond it, shape (n,).
    worth:
        What shows beyond each of these places, mm^2 times what that counts, shape (n,).
    band:
        All cells beyond it.
    """

    line: bytes
    length: float
    touched: BoolArray
    worth: FloatArray
    band: Band


def overhangs(plate: Plate, stencil: Stencil) -> tuple[Overhang, ...]:
    """What a plate shows beyond its hinges, as far as it touches them there."""
    over = stencil.mask & ~stencil.face
    if not over.any():
        return ()
    found = []
    seen = (stencil.slant.seen(plate.hinges) - stencil.low) / stencil.grain
    for line, ((s0, t0), (s1, t1)) in zip(plate.hinges, seen.tolist(), strict=True):
        if abs(t1 - t0) * stencil.grain[1] < STRAIGHT:
            along, span, at, cells, face = 0, (s0, s1), t0, over, stencil.face
        elif abs(s1 - s0) * stencil.grain[0] < STRAIGHT:
            along, span, at, cells, face = 1, (t0, t1), s0, over.T, stencil.face.T
        else:
            continue
        first, last, border = max(round(min(span)), 0), round(max(span)), round(at)
        if last <= first or not 0 < border < cells.shape[1]:
            continue
        middle = (first + last) // 2
        above, below = bool(face[middle, border]), bool(face[middle, border - 1])
        touched = cells[first:last, border - 1 if above else border]
        if above == below or not touched.any():
            continue
        beyond = cells[first:last, :border] if above else cells[first:last, border:]
        worth = beyond.sum(axis=1) * float(stencil.grain.prod()) * (1.0 if plate.lies else RISEN_WORTH)
        ends = line if line[0].tolist() < line[1].tolist() else line[::-1]
        length = float(np.linalg.norm(line[1] - line[0]))
        found.append(Overhang(ends.tobytes(), length, touched, worth, (along, first, last, border, above)))
    return tuple(found)


def crossed(plates: Sequence[tuple[Overhang, ...]]) -> Mapping[int, tuple[Band, ...]]:
    """Of the overhangs of some plates the bands that will be cut away, by the places of the plates."""
    lines: dict[bytes, list[tuple[int, Overhang]]] = {}
    for place, own in enumerate(plates):
        for overhang in own:
            lines.setdefault(overhang.line, []).append((place, overhang))
    cut: dict[int, tuple[Band, ...]] = {}
    for hinged in lines.values():
        for number, first in enumerate(hinged):
            for second in hinged[number + 1 :]:
                for place, band in _cut(first, second):
                    cut[place] = (*cut.get(place, ()), band)
    return cut


def _cut(first: tuple[int, Overhang], second: tuple[int, Overhang]) -> list[tuple[int, Band]]:
    """Of two plates that are hinged to each other those bands of less worth where both go on beyond the hinge."""
    pair = (first, second)
    count = max(len(overhang.touched) for _, overhang in pair)
    places = [((np.arange(count) + 0.5) * len(own.touched) / count).astype(int) for _, own in pair]
    both = first[1].touched[places[0]] & second[1].touched[places[1]]
    found = []
    for start, stop in np.flatnonzero(np.diff(both, prepend=False, append=False)).reshape(-1, 2).tolist():
        if (stop - start) * first[1].length / count > MAY_CROSS:
            spans = [(int(own[start]), int(own[stop - 1]) + 1) for own in places]
            worths = [own.worth[low:high].sum() for (_, own), (low, high) in zip(pair, spans, strict=True)]
            least = int(worths[1] < worths[0])
            place, overhang = pair[least]
            along, low, _, border, above = overhang.band
            found.append((place, (along, low + spans[least][0], low + spans[least][1], border, above)))
    return found


def without(stencil: Stencil, bands: Sequence[Band]) -> Stencil:
    """A stencil that shows nothing in some bands but in its face."""
    if not bands:
        return stencil
    mask = stencil.mask.copy()
    for along, first, last, border, above in bands:
        cells, face = (mask, stencil.face) if along == 0 else (mask.T, stencil.face.T)
        band = slice(first, last), slice(None, border) if above else slice(border, None)
        cells[band] &= face[band]
    return Stencil(stencil.slant, stencil.low, stencil.grain, mask, stencil.face)
