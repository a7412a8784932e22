"""The booklet as one HTML page that needs nothing else."""

from base64 import b64encode
from html import escape
from pathlib import Path

from popsim import wording
from popsim.booklet.booklet import PICTURE, Booklet
from popsim.booklet.inks import STYLE
from popsim.booklet.legend import legend
from popsim.export.svg import inline_svg
from popsim.export.textures import packed_texture

CSS = """
body { font: 1.05rem/1.5 "Bitstream Vera Sans", "DejaVu Sans", Verdana, sans-serif; color: #212429;
  max-width: 48rem; margin: 2rem auto; padding: 0 1rem; }
h1 { margin: 0; } .name { color: #73787f; margin: 0 0 1rem; font-size: 1.3rem; }
img, svg { max-width: 100%; height: auto; display: block; }
section { margin: 3rem 0; break-inside: avoid; }
section h2 { display: flex; gap: 1rem; align-items: baseline; font-size: 2.4rem; color: #0d4da6; margin: 0; }
section svg { width: 100%; }
dl { display: grid; grid-template-columns: 5rem 1fr; gap: .5rem 1rem; align-items: center; } dd { margin: 0; }
dt svg { width: 5rem; }
"""

FRAME = """<!doctype html>
<html lang="en">
<head>{head}<style>{css}</style></head>
<body>
{body}
</body>
</html>
"""


def page_of(booklet: Booklet, root: Path) -> str:
    """The whole page; pictures are read from the folder `root` and put into it."""
    content, kind = packed_texture(root, PICTURE)
    source = f"data:image/{kind.lower()};base64,{b64encode(content).decode()}"
    parts = [
        f'<h1>{escape(wording.TITLE)}</h1><p class="name">{escape(booklet.name)}</p>',
        f'<img src="{source}" alt="{escape(booklet.name)}">',
        f"<p>{escape(booklet.facts)}</p>",
        *([f"<p><strong>{escape(booklet.banner)}</strong></p>"] if booklet.banner is not None else []),
        _listed(wording.NEEDED, wording.TOOLS),
        f"<h2>{escape(wording.LEGEND)}</h2>\n<dl>",
        *(
            f"<dt>{inline_svg(sample, STYLE, root, f'legend-{k}')}</dt><dd>{escape(meaning)}</dd>"
            for k, (sample, meaning) in enumerate(legend(), 1)
        ),
        "</dl>",
        _listed(wording.ADVICE, wording.TIPS),
    ]
    for entry in booklet.entries:
        figure = inline_svg(entry.figure, STYLE, root, f"step-{entry.number}")
        heading = f'<h2 id="step-{entry.number}">{entry.number}</h2>'
        parts.append(f"<section>{heading}<p>{escape(entry.text)}</p>{figure}</section>")
    if booklet.checks:
        parts.append(_listed(wording.CHECKS, booklet.checks))
    title = f"{escape(wording.TITLE)}: {escape(booklet.name)}"
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{title}</title>'
    body = "\n".join(parts)
    return FRAME.format(head=head, css=CSS, body=body)


def _listed(heading: str, items: tuple[str, ...]) -> str:
    listed = "".join(f"<li>{escape(item)}</li>" for item in items)
    return f"<h2>{escape(heading)}</h2>\n<ul>{listed}</ul>"
