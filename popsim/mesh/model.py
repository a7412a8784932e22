"""A loaded model: its coloured triangles and where they came from."""

from dataclasses import dataclass
from pathlib import Path

from popsim.geometry.surface import Surface


@dataclass(frozen=True, eq=False)
class Model:
    """A model file as it was read.

    Attributes
    ----------
    path:
        The file.
    sha256:
        Hexadecimal digest of the bytes of that file (textures and material files are not part of it).
    surface:
        Triangles in *model coordinates*: the scene's own, with the transforms of its nodes applied, in the
        file's unit and before any change of the up axis.
    unit:
        mm that one unit of the model coordinates stands for.
    format:
        Name of the format, a value of :data:`popsim.mesh.formats.FORMATS`.
    notes:
        What had to be dropped or replaced, one sentence each.
    """

    path: Path
    sha256: str
    surface: Surface
    format: str
    unit: float = 1.0
    notes: tuple[str, ...] = ()
