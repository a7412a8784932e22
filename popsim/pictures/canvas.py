"""Strokes and words as SVG and as pixels."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

import numpy as np

from popsim.pictures.chart import Coordinates, Shape, Stroke, Words

if TYPE_CHECKING:
    from PIL.Image import Image

DASH, SPACE = 5.0, 4.0
"""Of dashed lines, px."""

SAMPLES = 2
"""Pixels per px of the figure and direction in a PNG."""

ANCHORS = {"start": "ls", "middle": "ms", "end": "rs"}
"""What Pillow calls them."""


def to_svg(shapes: Sequence[Shape], size: tuple[int, int]) -> str:
    """SVG on white, `size` px wide and high."""
    width, height = size
    body = "\n".join(_svg(shape) for shape in shapes)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="Helvetica, Arial, sans-serif">\n'
        f'<rect width="{width}" height="{height}" fill="white"/>\n{body}\n</svg>\n'
    )


def to_image(shapes: Sequence[Shape], size: tuple[int, int]) -> "Image":
    """RGB picture on white, SAMPLES times as wide and high as `size`."""
    from PIL import Image, ImageDraw, ImageFont

    fine = 2 * SAMPLES
    image = Image.new("RGB", (size[0] * fine, size[1] * fine), "white")
    draw = ImageDraw.Draw(image)
    for shape in shapes:
        if isinstance(shape, Words):
            at = (shape.at[0] * fine, shape.at[1] * fine)
            draw.text(
                at, shape.text, shape.colour, ImageFont.load_default(shape.size * fine), ANCHORS[shape.anchor]
            )
        elif len(shape.points) == 1:
            (x, y), radius = shape.points[0], shape.width / 2
            box = [(v * fine) for v in (x - radius, y - radius, x + radius, y + radius)]
            draw.ellipse(box, fill=shape.colour)
        else:
            for part in _dashes(shape.points) if shape.dashed else [shape.points]:
                scaled = [(x * fine, y * fine) for x, y in part]
                draw.line(scaled, shape.colour, round(shape.width * fine), joint="curve")
    return image.resize((size[0] * SAMPLES, size[1] * SAMPLES), Image.Resampling.BOX)


def _svg(shape: Shape) -> str:
    if isinstance(shape, Words):
        x, y = shape.at
        return (
            f'<text x="{x:.2f}" y="{y:.2f}" font-size="{shape.size}" fill="{shape.colour}" '
            f'text-anchor="{shape.anchor}">{escape(shape.text)}</text>'
        )
    if len(shape.points) == 1:
        x, y = shape.points[0]
        return f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{shape.width / 2:g}" fill="{shape.colour}"/>'
    return _svg_line(shape)


def _svg_line(stroke: Stroke) -> str:
    points = " ".join(f"{x:.2f},{y:.2f}" for x, y in stroke.points)
    pen = f'stroke="{stroke.colour}" stroke-width="{stroke.width:g}"'
    if stroke.dashed:
        pen += f' stroke-dasharray="{DASH:g} {SPACE:g}"'
    return f'<polyline points="{points}" fill="none" {pen}/>'


def _dashes(points: Coordinates) -> Iterator[Coordinates]:
    """The drawn parts of a dashed line, each a piece of one straight stretch."""
    done = 0.0
    for start, end in pairwise(np.array(points)):
        length = float(np.linalg.norm(end - start))
        first = np.floor(done / (DASH + SPACE)) * (DASH + SPACE)
        for begin in np.arange(first, done + length, DASH + SPACE):
            low, high = max(begin, done), min(begin + DASH, done + length)
            if high > low:
                ends = [start + (end - start) * (at - done) / length for at in (low, high)]
                yield tuple((float(x), float(y)) for x, y in ends)
        done += length
