"""SVG, one file per sheet, true scale, one Inkscape layer per role."""

import base64
from pathlib import Path
from typing import Any

import numpy as np

from popsim.export.job import CREASES, Job, own_file
from popsim.export.styles import WHITE, Colour, Style
from popsim.export.textures import packed_texture
from popsim.geometry.arrays import FloatArray
from popsim.layout.sheet import HALO, Area, Line, Mark, Picture, Role, Sheet, Text

FONTS = "Bitstream Vera Sans, DejaVu Sans, Verdana, sans-serif"

ANCHORS = {"start": "start", "middle": "middle", "end": "end"}


def write_svg(job: Job, path: Path) -> tuple[Path, ...]:
    """Write each sheet into its own file, named as :func:`popsim.export.job.own_file` does."""
    written = []
    for sheet in job.sheets:
        own = own_file(path, sheet)
        own.write_text(_drawing(sheet, job), encoding="utf-8")
        written.append(own)
    return tuple(written)


def _drawing(sheet: Sheet, job: Job) -> str:
    import drawsvg

    namespaces = {"xmlns:inkscape": "http://www.inkscape.org/namespaces/inkscape"}
    drawing = drawsvg.Drawing(sheet.width, sheet.height, **namespaces)
    drawing.set_render_size(f"{_number(sheet.width)}mm", f"{_number(sheet.height)}mm")
    drawing.append_title(f"{job.title}, {sheet.name}")
    for role in Role:
        marks = sheet.of(role)
        if not marks:
            continue
        layer = drawsvg.Group(id=role.value)
        layer.args |= {"inkscape:groupmode": "layer", "inkscape:label": role.value}
        if job.crease_advice and role in CREASES:
            layer.args["data-crease"] = job.crease_advice
        for index, mark in enumerate(marks):
            _draw(layer, mark, job.style, sheet, job.texture_root, f"{role.value}-{index}")
        drawing.append(layer)
    text: str = drawing.as_svg(randomize_ids=False)
    return text


def inline_svg(sheet: Sheet, style: Style, texture_root: Path, name: str) -> str:
    """One drawing as an SVG element for an HTML page, marks in their order.

    `name` is what the ids in it begin with, unique on the page; the page scales the drawing to its column.
    """
    import drawsvg

    drawing = drawsvg.Drawing(sheet.width, sheet.height)
    drawing.set_render_size(f"{_number(sheet.width)}mm", f"{_number(sheet.height)}mm")
    drawing.append_title(sheet.name)
    for index, mark in enumerate(sheet.marks):
        _draw(drawing, mark, style, sheet, texture_root, f"{name}-{index}")
    text: str = drawing.as_svg(randomize_ids=False, header="")
    return text


def _draw(layer: Any, mark: Mark, style: Style, sheet: Sheet, texture_root: Path, name: str) -> None:
    import drawsvg

    match mark:
        case Line():
            stroke = style.stroke(mark.looks or mark.role)
            args: dict[str, Any] = {"stroke": _colour(stroke.colour), "stroke_width": stroke.width, "fill": "none"}
            if stroke.dashes:
                args["stroke_dasharray"] = " ".join(_number(dash) for dash in stroke.dashes)
            layer.append(drawsvg.Path(_path((mark.points,), sheet, mark.closed), **args))
        case Area():
            fill = _colour(style.stroke(mark.looks or mark.role).colour)
            layer.append(drawsvg.Path(_path(mark.rings, sheet), fill=fill, fill_rule="evenodd", stroke="none"))
        case Text():
            layer.append(_text(mark, style, sheet))
        case Picture():
            layer.append(_picture(mark, sheet, texture_root, name))


def _text(mark: Text, style: Style, sheet: Sheet) -> Any:
    import drawsvg

    x, y = mark.at[0], sheet.height - mark.at[1]
    turn = f"translate({_number(x)} {_number(y)}) rotate({_number(-float(np.degrees(mark.angle)))})"
    rim: dict[str, Any] = {}
    if mark.halo:
        rim = {"stroke": _colour(WHITE), "stroke_width": _number(HALO * mark.size), "paint_order": "stroke"}
        rim["stroke_linejoin"] = "round"
    return drawsvg.Text(
        mark.text,
        _number(mark.size),
        0,
        0,
        fill=_colour(style.stroke(mark.role).colour),
        font_family=FONTS,
        font_weight="bold" if mark.bold else "normal",
        text_anchor=ANCHORS[mark.anchor],
        transform=turn,
        **rim,
    )


def _picture(mark: Picture, sheet: Sheet, texture_root: Path, name: str) -> Any:
    import drawsvg

    content, kind = packed_texture(texture_root, mark.image)
    data = f"data:image/{kind.lower()};base64,{base64.b64encode(content).decode()}"
    frame = mark.frame
    # the unit square has y up; the image is drawn with y down
    values = (frame[0, 0], -frame[1, 0], -frame[0, 1], frame[1, 1])
    corner = frame[:2, 2] + frame[:2, 1]
    matrix = " ".join(_number(v) for v in (*values, corner[0], sheet.height - corner[1]))
    clip = drawsvg.ClipPath(id=f"clip-{name}")
    clip.append(drawsvg.Path(_path(mark.clip, sheet), clip_rule="evenodd"))
    group = drawsvg.Group(clip_path=clip)
    size = 'width="1" height="1" preserveAspectRatio="none"'
    group.append(drawsvg.Raw(f'<image {size} transform="matrix({matrix})" xlink:href="{data}"/>'))
    return group


def _path(rings: tuple[FloatArray, ...], sheet: Sheet, closed: bool = True) -> str:
    commands = []
    for ring in rings:
        spots = [f"{_number(x)},{_number(sheet.height - y)}" for x, y in ring.tolist()]
        commands.append("M" + " L".join(spots) + (" Z" if closed else ""))
    return " ".join(commands)


def _colour(colour: Colour) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in colour)


def _number(value: float) -> str:
    """Shortest decimal at 0.1 micrometre."""
    return f"{value:.4f}".rstrip("0").rstrip(".") or "0"
