"""OBJ of one fold angle with its materials and pictures, mm; both sides of the paper as faces of their own."""

from collections.abc import Iterator
from pathlib import Path

from popsim.export.solid.scene import Leaf, Scene, placed
from popsim.export.textures import packed_texture
from popsim.geometry.arrays import FloatArray

SUFFIX = {"PNG": "png", "JPEG": "jpg"}


def write_obj(scene: Scene, path: Path) -> tuple[Path, ...]:
    """Write geometry, materials and pictures side by side; the same scene gives the same bytes.

    Returns
    -------
    The OBJ file, the MTL file, and the pictures.
    """
    materials = path.with_suffix(".mtl")
    pictures = {leaf.name: _picture(leaf, scene, path) for leaf in scene.leaves if leaf.texture is not None}
    lines = [f"mtllib {materials.name}"]
    first = 1
    for number, leaf in enumerate(scene.leaves):
        lines += _object(leaf, placed(scene, number), first)
        first += 3 * len(leaf.corners)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    known = [line for leaf in scene.leaves for line in _materials(leaf, pictures.get(leaf.name))]
    materials.write_text("\n".join(known) + "\n", encoding="utf-8")
    return (path, materials, *pictures.values())


def _object(leaf: Leaf, corners: FloatArray, first: int) -> Iterator[str]:
    """The two sides of a leaf; its vertices are numbered from `first`."""
    yield f"o {leaf.name}"
    yield from (f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in corners.reshape(-1, 3) + 0.0)
    yield from (f"vt {u:.5f} {v:.5f}" for u, v in leaf.uv.reshape(-1, 2) + 0.0)
    triples = [range(first + 3 * k, first + 3 * k + 3) for k in range(len(corners))]
    for side, faces in (("front", triples), ("back", [triple[::-1] for triple in triples])):
        yield f"usemtl {leaf.name}:{side}"
        yield from ("f " + " ".join(f"{k}/{k}" for k in triple) for triple in faces)


def _materials(leaf: Leaf, picture: Path | None) -> Iterator[str]:
    for side, colour in (("front", leaf.front), ("back", leaf.back)):
        yield f"newmtl {leaf.name}:{side}"
        yield "Kd " + " ".join(f"{part:.4f}" for part in colour)
        yield "illum 1"
        if picture is not None and side == "front":
            yield f"map_Kd {picture.name}"


def _picture(leaf: Leaf, scene: Scene, path: Path) -> Path:
    """Write the picture of a leaf beside the OBJ file."""
    content, kind = packed_texture(scene.textures, leaf.texture or "")
    picture = path.with_name(f"{path.stem}-{leaf.name.replace('/', '-')}.{SUFFIX[kind]}")
    picture.write_bytes(content)
    return picture
