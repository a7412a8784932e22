"""Extensions that a glTF file requires (glTF 2.0, 3.12): which popsim reads, and which it has to refuse."""

import json
import struct
from typing import Any, NamedTuple

READ = frozenset({"KHR_draco_mesh_compression", "KHR_mesh_quantization", "EXT_texture_webp"})
"""Extensions that change what is read from the file, and are followed."""

QUANTIZED = "KHR_mesh_quantization"
"""Read where integers are coordinates as they stand, and not where they are shares of a range (`normalized`)."""

LOOKS = ("KHR_materials_", "KHR_lights_", "EXT_lights_", "KHR_xmp")
"""What extensions are called that change neither the shape nor the base colour; they may be passed over."""

TEXTURES = ("KHR_texture_", "EXT_texture_", "MSFT_texture_")
"""What extensions are called that change textures only: the model is read without, and the report says so."""

_GLB, _JSON = b"glTF", b"JSON"


class Unread(NamedTuple):
    """Names of the extensions that a file requires and popsim does not read.

    Attributes
    ----------
    refused:
        Those without which its shape is another.
    textures:
        Those that change how textures are stored or laid; the model is read without.
    """

    refused: list[str]
    textures: list[str]


def unread_extensions(data: bytes) -> Unread:
    """Return what a glTF or GLB file requires and popsim does not read.

    Parameters
    ----------
    data:
        The file. One that is damaged requires nothing: the reader has more to say about it.
    """
    tree = _tree(data)
    required = tree.get("extensionsRequired")
    names = [str(name) for name in required] if isinstance(required, list) else []
    left = [name for name in names if name not in READ and not name.startswith(LOOKS)]
    refused = [name for name in left if not name.startswith(TEXTURES)]
    if QUANTIZED in names and _has_normalized_coordinates(tree):
        refused.append(QUANTIZED)
    return Unread(refused, [name for name in left if name.startswith(TEXTURES)])


def _tree(data: bytes) -> dict[str, Any]:
    """Return the JSON of a file, empty where there is none."""
    text = data
    if data[:4] == _GLB:
        if len(data) < 20 or data[16:20] != _JSON:
            return {}
        text = data[20 : 20 + struct.unpack_from("<I", data, 12)[0]]
    try:
        tree = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return tree if isinstance(tree, dict) else {}


def _has_normalized_coordinates(tree: dict[str, Any]) -> bool:
    """Whether positions or texture coordinates are integers that stand for shares of their range."""
    try:
        used = [
            index
            for mesh in tree["meshes"]
            for primitive in mesh["primitives"]
            for name, index in primitive["attributes"].items()
            if name == "POSITION" or name.startswith("TEXCOORD")
        ]
        return any(tree["accessors"][index].get("normalized", False) for index in used)
    except (KeyError, IndexError, TypeError, AttributeError):
        return False
