"""Reading exported sheets back with other libraries: lines, glue areas and texts by what they mean.

Lengths are mm from the lower left corner of the paper, y up. SVG and DXF say what a line means by its layer; in
a PDF the preset `origami` tells it by colour and dashes, as a reader of the legend would.
"""

import ctypes
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import ezdxf
import numpy as np
import pypdfium2
import pypdfium2.raw as pdfium
import shapely
from svgelements import SVG, Group, Text
from svgelements import Path as SvgPath

LAYERS = ("cut", "mountain", "valley")

MM = 25.4 / 72
"""Of a point."""

SAME = 0.5
"""mm."""

PALE, RED, BLUE, BLACK = (217, 217, 217), (217, 0, 0), (0, 51, 217), (0, 0, 0)
"""Colours of the preset `origami`, 0..255: glue areas, mountain, valley, cut."""


@dataclass
class Side:
    """One side of a sheet: lines by layer, each (n, 2), closed ones with the first point again."""

    cut: list[np.ndarray] = field(default_factory=list)
    mountain: list[np.ndarray] = field(default_factory=list)
    valley: list[np.ndarray] = field(default_factory=list)
    glue: list[shapely.Polygon] = field(default_factory=list)
    texts: list[tuple[str, np.ndarray]] = field(default_factory=list)


def read_svg(path: Path) -> list[Side]:
    """With svgelements at 25.4 units per inch: one unit is a millimetre."""
    svg = SVG.parse(str(path), ppi=25.4)
    side = Side()
    for group in svg.select(lambda element: isinstance(element, Group)):
        for shape in group.select(lambda element: isinstance(element, SvgPath)):
            points = [(p.x, svg.height - p.y) for segment in shape for p in (segment.start, segment.end) if p]
            kept = np.array([points[0]] + [b for a, b in pairwise(points) if a != b])
            if group.id in LAYERS:
                getattr(side, group.id).append(kept)
            elif group.id == "glue":
                side.glue.append(shapely.Polygon(kept))
        if group.id == "label":
            for text in group.select(lambda element: isinstance(element, Text)):
                x, y = text.transform.point_in_matrix_space((0, -0.3 * text.font_size))
                side.texts.append((text.text, np.array([x, svg.height - y])))
    return [side]


def read_dxf(path: Path) -> list[Side]:
    """With ezdxf."""
    side = Side()
    space = ezdxf.readfile(path).modelspace()
    for line in space.query("LWPOLYLINE"):
        points = np.array([point[:2] for point in line.get_points()])
        if line.dxf.layer in LAYERS:
            getattr(side, line.dxf.layer).append(np.vstack([points, points[:1]]) if line.closed else points)
        elif line.dxf.layer == "glue":
            side.glue.append(shapely.Polygon(points))
    for text in space.query("TEXT"):
        turn = np.radians(text.dxf.rotation)
        up = 0.4 * text.dxf.height * np.array([-np.sin(turn), np.cos(turn)])
        side.texts.append((text.dxf.text, np.array(list(text.get_placement()[1].vec2)) + up))
    return [side]


def read_pdf(path: Path) -> list[Side]:
    """With pdfium: paths by colour and dashes, texts by their boxes."""
    return [_read_page(page) for page in pypdfium2.PdfDocument(path)]


def _read_page(page: pypdfium2.PdfPage) -> Side:
    side, words = Side(), page.get_textpage()
    for element in page.get_objects():
        if element.type == pdfium.FPDF_PAGEOBJ_PATH:
            filled, stroked = ctypes.c_int(), ctypes.c_int()
            pdfium.FPDFPath_GetDrawMode(element.raw, filled, stroked)
            rings = list(_rings(element))
            if stroked.value:
                layer = _layer(element)
                if layer:
                    getattr(side, layer).extend(rings)
            elif _near(_colour(pdfium.FPDFPageObj_GetFillColor, element), PALE):
                side.glue += [shapely.Polygon(ring) for ring in rings]
        elif element.type == pdfium.FPDF_PAGEOBJ_TEXT:
            left, low, right, high = (ctypes.c_float() for _ in range(4))
            pdfium.FPDFPageObj_GetBounds(element.raw, left, low, right, high)
            spot = MM * np.array([left.value + right.value, low.value + high.value]) / 2
            text = _text(element, words)
            if all(known != text or np.abs(other - spot).max() > SAME for known, other in side.texts):
                side.texts.append((text, spot))  # the rim round letters is the same text once more
    return side


def _rings(element: pypdfium2.PdfObject) -> Iterator[np.ndarray]:
    """The polylines of a path, closed ones with the first point again."""
    ring: list[tuple[float, float]] = []
    x, y = ctypes.c_float(), ctypes.c_float()
    for k in range(pdfium.FPDFPath_CountSegments(element.raw)):
        segment = pdfium.FPDFPath_GetPathSegment(element.raw, k)
        pdfium.FPDFPathSegment_GetPoint(segment, x, y)
        if pdfium.FPDFPathSegment_GetType(segment) == pdfium.FPDF_SEGMENT_MOVETO and ring:
            yield MM * np.array(ring)
            ring = []
        ring.append((x.value, y.value))
        if pdfium.FPDFPathSegment_GetClose(segment):
            ring.append(ring[0])
    if ring:
        yield MM * np.array(ring)


def _layer(element: pypdfium2.PdfObject) -> str | None:
    """What a stroked path means, by the legend: None for scale bars and the like."""
    colour = _colour(pdfium.FPDFPageObj_GetStrokeColor, element)
    dashes = pdfium.FPDFPageObj_GetDashCount(element.raw)
    for layer, look, count in (("cut", BLACK, 0), ("mountain", RED, 4), ("valley", BLUE, 2)):
        if _near(colour, look) and dashes == count:
            return layer
    return None


def _colour(getter: Callable[..., int], element: pypdfium2.PdfObject) -> tuple[int, ...]:
    parts = [ctypes.c_uint() for _ in range(4)]
    getter(element.raw, *parts)
    return tuple(part.value for part in parts[:3])


def _near(one: tuple[int, ...], other: tuple[int, ...]) -> bool:
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) <= 2


def _text(element: pypdfium2.PdfObject, words: pypdfium2.PdfTextPage) -> str:
    size = pdfium.FPDFTextObj_GetText(element.raw, words.raw, None, 0)
    buffer = (ctypes.c_ushort * (size // 2))()
    pdfium.FPDFTextObj_GetText(element.raw, words.raw, buffer, size)
    return bytes(buffer).decode("utf-16-le").rstrip("\0").strip()


READERS: dict[str, Callable[[Path], list[Side]]] = {"svg": read_svg, "dxf": read_dxf, "pdf": read_pdf}
