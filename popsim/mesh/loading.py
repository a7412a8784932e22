"""Reads a model file into a coloured surface; the only way from a file to geometry."""

import hashlib
import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from popsim.errors import MeshError
from popsim.files import read_bytes
from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Material, Surface
from popsim.mesh.cleaning import usable_triangles
from popsim.mesh.formats import ModelFormat, format_of
from popsim.mesh.gltf_extensions import Unread, unread_extensions
from popsim.mesh.materials import Look, look_of
from popsim.mesh.model import Model

_DISPLAY_COLOUR_WRITER = b"github.com/mikedh/trimesh"
"""Generator of glTF files whose factors are display values, against the standard."""


def load_model(path: Path | str) -> Model:
    """Read a model.

    Parameters
    ----------
    path:
        A file with a suffix of :data:`popsim.mesh.formats.FORMATS`, in any letter case.

    Returns
    -------
    Model
        All geometries of the scene as one surface, with their materials, textures and vertex or face
        colours. Faces without an area or with undefined coordinates are left out and noted; a texture that
        is missing or damaged is noted and the colour of its material used.

    Raises
    ------
    InputError
        The file is missing, a folder, or may not be read.
    MeshError
        It is empty, not of a known format, damaged, needs an extension that is not read, or holds no surface.
    """
    path = Path(path)
    known = format_of(path)
    data = read_bytes(path, "model")
    if not data.strip():
        raise MeshError(f"{path.name}: the file is empty")
    unread = unread_extensions(data) if known.extensible else Unread([], [])
    if unread.refused:
        raise MeshError(_extended(path, unread.refused))
    linear = known.linear_colours and _DISPLAY_COLOUR_WRITER not in data
    with _quiet():
        meshes, notes = _parse(path, known, data)
        lack = "is not read; textures may be missing or out of place"
        notes += [f"the glTF extension {name} {lack}" for name in unread.textures]
        parts = [_part(mesh, visual, linear=linear) for mesh, visual in meshes]
    corners = np.concatenate([c for c, _ in parts]) if parts else np.zeros((0, 3, 3))
    keep, dropped = usable_triangles(corners, path)
    surface = _joined(corners, [look for _, look in parts], keep)
    problems = dict.fromkeys(look.problem for _, look in parts if look.problem)
    return Model(
        path=path,
        sha256=hashlib.sha256(data).hexdigest(),
        surface=surface,
        format=known.name,
        unit=known.unit,
        notes=(*notes, *problems, *dropped),
    )


def _parse(path: Path, known: ModelFormat, data: bytes) -> tuple[list[tuple[Any, Any]], list[str]]:
    """Return the trimesh meshes of the scene, in place, each with its visual; and what its materials lacked."""
    import trimesh  # slow: only when a model is read

    from popsim.mesh.assets import AssetResolver  # imports trimesh

    resolver = AssetResolver(path)
    try:
        scene = trimesh.load_scene(BytesIO(data), file_type=known.reader, resolver=resolver, process=False)
        meshes = _in_place(scene)
    except Exception as error:  # readers raise whatever their parsing trips over
        raise MeshError(_unreadable(path, known, error, _needed(resolver.missing, data))) from error
    beside = f"is missing beside {path.name}; plain colours are used instead"
    notes = [f"'{name}' {beside}" for name in resolver.missing]
    notes += [f"'{name}' is not an image; plain colours are used instead" for name in resolver.unreadable]
    return meshes, notes


def _in_place(scene: Any) -> list[tuple[Any, Any]]:
    """Return each geometry at each of its places, as `trimesh.load(force="mesh")` does, with its visual."""
    from trimesh import Trimesh
    from trimesh.visual import ColorVisuals

    solid = {name: mesh for name, mesh in scene.geometry.items() if isinstance(mesh, Trimesh)}  # not points, lines
    visuals = {name: mesh.visual for name, mesh in solid.items()}
    for mesh in solid.values():
        mesh.visual = ColorVisuals()  # else every copy in the dump decodes and copies the textures
    meshes = [mesh for mesh in scene.dump() if mesh.metadata["name"] in solid and len(mesh.faces)]
    return [(mesh, visuals[mesh.metadata["name"]]) for mesh in meshes]


def _needed(missing: list[str], data: bytes) -> str | None:
    """Return the first missing file that the model itself names (readers also try names of their own)."""
    return next((name for name in missing if name.encode() in data), None)


def _unreadable(path: Path, known: ModelFormat, error: Exception, needed: str | None) -> str:
    if needed:
        return f"{path.name}: needs the file '{needed}', which is missing beside it"
    lines = str(error).strip().splitlines()
    reason = f" ({lines[0][:120]})" if lines else ""
    return f"{path.name}: cannot be read as {known.name}; the file is damaged or of another format{reason}"


def _extended(path: Path, unread: list[str]) -> str:
    names = f"the glTF extension{'s' if len(unread) > 1 else ''} {' and '.join(unread)}"
    packed = any("compression" in name or "quantization" in name for name in unread)
    again = "without compression" if packed else "without"
    return f"{path.name}: needs {names}, which popsim does not read; export the model {again}"


def _part(mesh: Any, visual: Any, *, linear: bool) -> tuple[FloatArray, Look]:
    """Return the corners (n, 3, 3) and the colours of one mesh."""
    faces = np.asarray(mesh.faces)
    return np.asarray(mesh.vertices[faces], dtype=np.float64), look_of(visual, faces, linear=linear)


def _joined(corners: FloatArray, looks: list[Look], keep: np.ndarray[Any, Any]) -> Surface:
    materials: list[Material] = []
    known: dict[tuple[bytes, bytes | None], int] = {}
    index = []
    for look in looks:
        key = _fingerprint(look.material)
        if key not in known:
            known[key] = len(materials)
            materials.append(look.material)
        index.append(np.full(len(look.uv), known[key]))
    colours = None
    if any(look.colours is not None for look in looks):
        colours = np.concatenate([np.ones((len(k.uv), 3, 4)) if k.colours is None else k.colours for k in looks])[
            keep
        ]
    uv = np.concatenate([look.uv for look in looks])[keep]
    return Surface(corners[keep], uv, np.concatenate(index)[keep], tuple(materials), colours)


def _fingerprint(material: Material) -> tuple[bytes, bytes | None]:
    texture = material.texture
    return material.colour.tobytes(), None if texture is None else hashlib.sha256(texture.tobytes()).digest()


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence the log and the warnings of trimesh and Pillow: what matters becomes a note or an error."""
    logger = logging.getLogger("trimesh")  # its modules log as "trimesh.util" and so on, which end here
    before, silent = logger.propagate, logging.NullHandler()
    logger.propagate = False
    logger.addHandler(silent)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logger.removeHandler(silent)
        logger.propagate = before
