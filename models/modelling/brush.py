"""A brush that paints one view in model units."""

from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw, ImageFont

Colour = str  # anything that Pillow reads: "#rrggbb"

SMOOTHING = 4  # pictures are drawn this much larger and averaged down: smooth edges


@dataclass(frozen=True, eq=False)
class Brush:
    """Paints on `canvas`; a and b are the view's horizontal and vertical model axes.

    Attributes
    ----------
    origin:
        Model coordinates (a, b) of the top left corner of the view.
    scale:
        Pixels per unit in the finished picture.
    mirrored:
        Whether a runs from right to left. Text never is.
    margin:
        Finished pixels around the view.
    """

    canvas: Image.Image
    draw: ImageDraw.ImageDraw
    origin: tuple[float, float]
    scale: float
    mirrored: bool
    margin: int

    def picture(self) -> Image.Image:
        """Return the finished picture, margin included."""
        return self.canvas.reduce(SMOOTHING)

    def rect(
        self,
        across: tuple[float, float],
        upward: tuple[float, float],
        fill: Colour,
        radius: float = 0.0,
        *,
        line: Colour | None = None,
        width: float = 0.02,
    ) -> None:
        """Paint a rectangle with rounded corners and, if `line` is given, an inner border."""
        (x0, y0), (x1, y1) = (self._pixel(a, b) for a, b in zip(across, upward, strict=True))
        corners = (min(x0, x1), min(y0, y1), max(x0, x1) - 1, max(y0, y1) - 1)
        if corners[0] > corners[2] or corners[1] > corners[3]:
            return
        border = 0 if line is None else max(1, round(width * self._fine))
        self.draw.rounded_rectangle(corners, radius * self._fine, fill, line, border)

    def polygon(self, points: Sequence[tuple[float, float]], fill: Colour) -> None:
        """Paint a polygon."""
        self.draw.polygon([self._pixel(*p) for p in points], fill)

    def line(self, points: Sequence[tuple[float, float]], fill: Colour, width: float) -> None:
        """Paint an open polyline of a width in model units."""
        pixels = [self._pixel(*p) for p in points]
        self.draw.line(pixels, fill, max(1, round(width * self._fine)), joint="curve")

    def disc(self, centre: tuple[float, float], radius: float, fill: Colour) -> None:
        """Paint a disc."""
        x, y = self._pixel(*centre)
        r = radius * self._fine
        self.draw.ellipse((x - r, y - r, x + r, y + r), fill)

    def text(self, centre: tuple[float, float], words: str, height: float, fill: Colour) -> None:
        """Paint a line of capitals `height` tall, centred, never mirrored."""
        font = ImageFont.load_default(height * self._fine / 0.71)  # capitals are 0.71 of the size of this font
        stroke = max(1, round(height * self._fine * 0.04))
        self.draw.text(self._pixel(*centre), words, fill, font, anchor="mm", stroke_width=stroke, stroke_fill=fill)

    @property
    def _fine(self) -> float:
        """Drawn pixels per unit."""
        return self.scale * SMOOTHING

    def _pixel(self, a: float, b: float) -> tuple[float, float]:
        """Drawn pixel of a model point."""
        offset = self.margin * SMOOTHING
        sign = -1 if self.mirrored else 1
        return (
            offset + sign * (a - self.origin[0]) * self._fine,
            offset + (self.origin[1] - b) * self._fine,
        )
