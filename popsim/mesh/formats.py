"""The model formats that popsim reads, and which axes each of them calls up and front."""

from dataclasses import dataclass
from pathlib import Path

from popsim.errors import MeshError

FRONT_UP_AXIS, FRONT_AXIS = "y", "z"
"""Customs of the front go with this up axis, and name this axis."""

NO_CUSTOM = 0.5
"""Prior weight of a front that no custom names."""


@dataclass(frozen=True)
class ModelFormat:
    """One file format.

    Attributes
    ----------
    name:
        What messages and reports call it.
    reader:
        The file type by which trimesh knows it.
    up:
        How likely each model axis is to point up, by the standard or the custom of the format;
        axes not listed are taken to be :data:`OTHER_AXIS`.
    front:
        How likely :data:`FRONT_AXIS` is the front of a model that stands along :data:`FRONT_UP_AXIS`, by the
        standard or the custom of the format, against its opposite; :data:`NO_CUSTOM` where there is neither.
    linear_colours:
        Whether colour factors are linear light (glTF 2.0, 3.9.2) and not display values.
    extensible:
        Whether files may require extensions, as glTF 2.0, 3.12 has them.
    unit:
        mm that one unit of a file stands for, by the standard; 1 where there is none.
    """

    name: str
    reader: str
    up: dict[str, float]
    front: float = NO_CUSTOM
    linear_colours: bool = False
    extensible: bool = False
    unit: float = 1.0


OTHER_AXIS = 0.01
"""Prior weight of an axis that no custom of a format calls up; not zero, for files do break customs."""

METRE = 1000.0
"""mm; the unit of glTF 2.0 (3.4)."""

_GLTF_UP = {"y": 0.95, "z": 0.02}  # glTF 2.0, 3.4: +y is up; exporters turn the model
_GLTF_FRONT = 0.95  # glTF 2.0, 3.4: the front of an asset faces +z
_OBJ_UP = {"y": 0.60, "z": 0.35}  # no rule: y from games and modellers, z from CAD and robotics
_OBJ_FRONT = 0.75  # a habit of those who model with y up: of 13 whose front is known it is that of twelve
_PRINT_UP = {"z": 0.90, "y": 0.05}  # slicers and CAD build along z
_SCAN_UP = {"z": 0.60, "y": 0.30}  # no rule

FORMATS: dict[str, ModelFormat] = {
    ".obj": ModelFormat("OBJ", "obj", _OBJ_UP, _OBJ_FRONT),
    ".stl": ModelFormat("STL", "stl", _PRINT_UP),
    ".ply": ModelFormat("PLY", "ply", _SCAN_UP),
    ".off": ModelFormat("OFF", "off", _SCAN_UP),
    ".glb": ModelFormat("GLB", "glb", _GLTF_UP, _GLTF_FRONT, linear_colours=True, extensible=True, unit=METRE),
    ".gltf": ModelFormat("glTF", "gltf", _GLTF_UP, _GLTF_FRONT, linear_colours=True, extensible=True, unit=METRE),
    ".3mf": ModelFormat("3MF", "3mf", _PRINT_UP),
}
"""Suffix (lower case, with its dot) to format. A new format is one more row."""


def format_of(path: Path) -> ModelFormat:
    """Return the format of a model file by its suffix.

    Raises
    ------
    MeshError
        No format has this suffix.
    """
    known = FORMATS.get(path.suffix.lower())
    if known is None:
        raise MeshError(
            f"{path.name}: the suffix '{path.suffix}' is not a model format; expected one of {' '.join(FORMATS)}"
        )
    return known
