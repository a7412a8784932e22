"""DXF (R2010, millimetres), one file per sheet, one layer per role, for machines that take nothing else.

Only lines and texts: pictures and filled areas have no place in cutting software. Glue areas are outlined.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from popsim.export.job import CREASES, Job, own_file
from popsim.export.styles import Colour
from popsim.geometry.arrays import FloatArray
from popsim.layout.sheet import Area, Line, Mark, Meaning, Picture, Role, Sheet, Text

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts.layout import Modelspace

MILLIMETRES = 4
"""$INSUNITS."""


def write_dxf(job: Job, path: Path) -> tuple[Path, ...]:
    """Write each sheet into its own file, named as :func:`popsim.export.job.own_file` does; no pictures."""
    written = []
    for sheet in job.sheets:
        own = own_file(path, sheet)
        with _fixed_dates():
            _document(sheet, job).saveas(own)
        written.append(own)
    return tuple(written)


def _document(sheet: Sheet, job: Job) -> "Drawing":
    from ezdxf.filemanagement import new

    document = new("R2010")
    document.header["$INSUNITS"] = MILLIMETRES
    document.header["$MEASUREMENT"] = 1
    document.header["$EXTMIN"], document.header["$EXTMAX"] = (0, 0, 0), (sheet.width, sheet.height, 0)
    for role in Role:
        stroke = job.style.stroke(role)
        layer = document.layers.add(role.value, true_color=_true_colour(stroke.colour))
        layer.dxf.lineweight = _line_weight(stroke.width)
        if job.crease_advice and role in CREASES:
            layer.description = job.crease_advice
        if stroke.dashes:
            document.linetypes.add(role.value, pattern=_pattern(stroke.dashes), description=role.value)
            layer.dxf.linetype = role.value
    space = document.modelspace()
    for mark in sheet.marks:
        if mark.role is not Role.PRINT:  # pictures, and white under creases on them
            _draw(space, mark)
    return document


def _draw(space: "Modelspace", mark: Mark) -> None:
    from ezdxf.enums import TextEntityAlignment

    layer = {"layer": mark.role.value}
    match mark:
        case Line():
            look = {} if mark.looks is None else {"color": 256, "linetype": _look(space, mark.looks)}
            space.add_lwpolyline(_rounded(mark.points), close=mark.closed, dxfattribs=layer | look)
        case Area():
            for ring in mark.rings:
                space.add_lwpolyline(_rounded(ring), close=True, dxfattribs=layer)
        case Text():
            align = {
                "start": TextEntityAlignment.LEFT,
                "middle": TextEntityAlignment.CENTER,
                "end": TextEntityAlignment.RIGHT,
            }
            text = space.add_text(
                mark.text, height=0.73 * mark.size, rotation=float(np.degrees(mark.angle)), dxfattribs=layer
            )
            text.set_placement(tuple(_rounded(mark.at[None])[0]), align=align[mark.anchor])
        case Picture():
            pass


def _look(space: "Modelspace", role: Meaning) -> str:
    document = space.doc
    return role.value if document is not None and role.value in document.linetypes else "CONTINUOUS"


def _rounded(points: FloatArray) -> list[tuple[float, float]]:
    return [(float(x), float(y)) for x, y in np.round(points, 4) + 0.0]


def _pattern(dashes: tuple[float, ...]) -> list[float]:
    """Total length, then dashes (positive) and gaps (negative)."""
    return [sum(dashes), *(dash if k % 2 == 0 else -dash for k, dash in enumerate(dashes))]


def _true_colour(colour: Colour) -> int:
    red, green, blue = (round(255 * part) for part in colour)
    return red << 16 | green << 8 | blue


def _line_weight(width: float) -> int:
    """The nearest line weight that the format knows, 1/100 mm."""
    return min((9, 13, 15, 18, 20, 25, 30, 35, 40, 50), key=lambda weight: abs(weight - 100 * width))


@contextmanager
def _fixed_dates() -> Iterator[None]:
    """Documents made and saved meanwhile carry a fixed date and id: the same sheet gives the same bytes."""
    from ezdxf._options import options

    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before
