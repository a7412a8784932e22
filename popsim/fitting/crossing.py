"""Of two plates that would both reach beyond their common hinge one will end there.

Contours are cut so (:mod:`popsim.patches.crossing`), stretch by stretch of the hinge; here cell by cell.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from popsim.fitting.lines import Line, lines_among
from popsim.fitting.stencil import Stencil
from popsim.geometry.arrays import BoolArray, FloatArray
from popsim.mechanisms import Plate
from popsim.stock import MAY_CROSS, worth_beyond


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
    cells:
        The hinge among the cells of the stencil.
    """

    line: bytes
    length: float
    touched: BoolArray
    worth: FloatArray
    cells: Line


def overhangs(plate: Plate, stencil: Stencil) -> tuple[Overhang, ...]:
    """What a plate shows beyond its hinges, as far as it touches them there."""
    over = stencil.mask & ~stencil.face
    if not over.any():
        return ()
    found = []
    seen = stencil.slant.seen(plate.hinges)
    counts = float(stencil.grain.prod()) * worth_beyond(lies=plate.lies)
    for place, line in lines_among(seen, stencil.low, stencil.grain, stencil.face):
        beyond = line.beyond(over)
        if beyond[:, 0].any():
            start, end = plate.hinges[place]
            ends = plate.hinges[place] if start.tolist() < end.tolist() else plate.hinges[place, ::-1]
            length = float(np.linalg.norm(end - start))
            found.append(Overhang(ends.tobytes(), length, beyond[:, 0], counts * beyond.sum(axis=1), line))
    return tuple(found)


def crossed(plates: Sequence[tuple[Overhang, ...]]) -> Mapping[int, tuple[Line, ...]]:
    """Stretches of hinges beyond which plates will be cut away, by the places of the plates."""
    lines: dict[bytes, list[tuple[int, Overhang]]] = {}
    for place, own in enumerate(plates):
        for overhang in own:
            lines.setdefault(overhang.line, []).append((place, overhang))
    cut: dict[int, tuple[Line, ...]] = {}
    for hinged in lines.values():
        for number, first in enumerate(hinged):
            for second in hinged[number + 1 :]:
                for place, line in _cut(first, second):
                    cut[place] = (*cut.get(place, ()), line)
    return cut


def _cut(first: tuple[int, Overhang], second: tuple[int, Overhang]) -> list[tuple[int, Line]]:
    """Where two plates both go on beyond their hinge: which of them shows less there, and its stretches of it."""
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
            low, high = (overhang.cells.first + end for end in spans[least])
            found.append((place, overhang.cells._replace(first=low, last=high)))
    return found


def without(stencil: Stencil, lines: Sequence[Line]) -> Stencil:
    """A stencil that shows nothing beyond some lines but in its face."""
    if not lines:
        return stencil
    mask = stencil.mask.copy()
    for line in lines:
        cells = line.beyond(mask)
        cells &= line.beyond(stencil.face)
    return Stencil(stencil.slant, stencil.low, stencil.grain, mask, stencil.face)
