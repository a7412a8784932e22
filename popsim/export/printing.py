"""How the sheets of a layout are printed, whatever the format."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Printing:
    """What may be said about sheets beside the layout itself.

    Attributes
    ----------
    style:
        A name in :data:`popsim.export.styles.STYLES`.
    two_sided:
        Follow each sheet by its mirrored reverse.
    footer:
        What reproduces the sheets: command, version, seed, input hash.
    banner:
        A warning on every sheet, or None.
    notes:
        What to check, on the last sheet where there is room, else on one more.
    """

    style: str = "origami"
    two_sided: bool = False
    footer: str = ""
    banner: str | None = None
    notes: tuple[str, ...] = ()
