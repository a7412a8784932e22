"""Of two plates that would both reach beyond their common hinge one will end there.

Contours are cut so (:mod:`popsim.patches.crossing`), stretch by stretch of the hinge; here cell by cell.
"""

from collections.abc import Mapping, Sequence
from math import dist
from typing import NamedTuple

from popsim.fitting.kernels.records import Line
from popsim.fitting.shape import Shape
from popsim.fitting.stencil import Stencil
from popsim.geometry.arrays import IntArray
from popsim.stock import MAY_CROSS, worth_beyond


class Overhang(NamedTuple):
    """What a plate shows beyond one of its hinges.

    Attributes
    ----------
    line:
        Ends of the hinge, mm, the lesser first, six numbers: the same for both plates.
    length:
        Of the hinge, mm.
    counts:
        In each place along it, how many cells show something beyond, where that touches it, shape (n,).
    worth:
        Of a cell, mm^2 times what that counts.
    cells:
        The hinge among the cells of the stencil.
    """

    line: tuple[float, ...]
    length: float
    counts: IntArray
    worth: float
    cells: Line


def overhangs(plate: Shape, stencil: Stencil) -> tuple[Overhang, ...]:
    """What a plate shows beyond its hinges, as far as it touches them there."""
    from popsim.fitting.kernels.hinges import overhangs as counted

    seen = stencil.slant.seen(plate.hinges)
    places, lines, counts = counted(seen, stencil.low, stencil.grain, stencil.face, stencil.mask)
    if not len(lines):
        return ()
    each = float(stencil.grain[0] * stencil.grain[1]) * worth_beyond(lies=plate.lies)
    found = []
    for place, fields, count in zip(places.tolist(), lines.tolist(), counts, strict=True):
        along, first, last, border, above = fields
        line = Line(along, first, last, border, bool(above))
        start, end = sorted(plate.hinges[place].tolist())
        found.append(Overhang((*start, *end), dist(start, end), count[: last - first], each, line))
    return tuple(found)


def crossed(plates: Sequence[tuple[Overhang, ...]]) -> Mapping[int, tuple[Line, ...]]:
    """Stretches of hinges beyond which plates will be cut away, by the places of the plates."""
    lines: dict[tuple[float, ...], list[tuple[int, Overhang]]] = {}
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
    from popsim.fitting.kernels.hinges import crossings

    one, other = first[1], second[1]
    found = []
    for least, start, stop in crossings(
        one.counts, other.counts, one.worth, other.worth, one.length, MAY_CROSS
    ).tolist():
        place, overhang = (first, second)[least]
        line = overhang.cells
        found.append((place, line._replace(first=line.first + start, last=line.first + stop)))
    return found


def without(stencil: Stencil, lines: Sequence[Line]) -> Stencil:
    """A stencil that shows nothing beyond some lines but in its face."""
    from popsim.fitting.kernels.hinges import cut_off

    if not lines:
        return stencil
    mask = stencil.mask.copy()
    for line in lines:
        cut_off(mask, stencil.face, line)
    return Stencil(stencil.slant, stencil.low, stencil.grain, mask, stencil.face)
