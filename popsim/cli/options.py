"""Options that several commands share: what is printed, on what, and for which machine."""

from typing import Annotated

import typer

Paper = Annotated[
    str, typer.Option(help='Sheet (A4, Letter, 300x400mm), weight (200gsm) or both ("Letter 160gsm").')
]
Style = Annotated[str, typer.Option(help="Line style of the sheets.")]
Formats = Annotated[
    list[str] | None, typer.Option(help="pdf, svg, dxf or fold; may be repeated. By default pdf and svg.")
]
TwoSided = Annotated[bool, typer.Option("--two-sided", help="Mirrored sheets for the back.")]
Grain = Annotated[bool, typer.Option("--grain", help="The paper's grain runs along the fold in all pieces.")]
Registration = Annotated[
    str, typer.Option(help="Marks and limits of a cutting machine: none, silhouette or cricut.")
]
ForceFolder = Annotated[bool, typer.Option("--force", help="Write into a folder that is not empty.")]


USUAL_STYLE, UNMARKED = "origami", "none"
"""Line style and registration marks where nothing is said."""


def chosen_formats(stated: list[str] | None) -> tuple[str, ...]:
    """The formats of sheets, each once; PDF and SVG where none is stated."""
    return tuple(dict.fromkeys(stated or ("pdf", "svg")))


def printed_words(style: str, *, two_sided: bool, grain: bool, registration: str) -> list[str]:
    """What was chosen of these options other than the usual, as words of a command."""
    chosen = {"--two-sided": two_sided, "--grain": grain}
    words = [] if style == USUAL_STYLE else [f"--style {style}"]
    words += [name for name, on in chosen.items() if on]
    return words if registration == UNMARKED else [*words, f"--registration {registration}"]
