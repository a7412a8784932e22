"""Writers of the mesh formats, plain enough that the same mesh always gives the same bytes."""

import json
import struct
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

from modelling.mesh import FloatArray, IntArray, Mesh, normals

_DIGITS = 5  # decimals kept: far below a printed dot, and above what differs between processors
_FLOAT, _USHORT = 5126, 5123  # component types of glTF
_VERTICES, _INDICES = 34962, 34963  # buffer targets of glTF


def write_obj(
    path: Path,
    mesh: Mesh,
    materials: Mapping[str, tuple[float, float, float]],
    image: Image.Image | None = None,
) -> None:
    """Write `mesh` as OBJ with an MTL of `materials` (name: RGB, 0..1) and, if given, one PNG for all of them."""
    stem = path.stem
    points, corners = _welded(mesh.triangles)
    uv, uv_corners = _welded(mesh.uv)
    lines = [f"mtllib {stem}.mtl", *(f"v {_row(p)}" for p in points)]
    if image is not None:
        lines += [f"vt {_row(t)}" for t in uv]
    for name in materials:
        lines.append(f"usemtl {name}")
        for index in np.flatnonzero(mesh.material == name):
            pairs = zip(corners[index] + 1, uv_corners[index] + 1, strict=True)
            lines.append("f " + " ".join(f"{v}/{t}" if image is not None else f"{v}" for v, t in pairs))
    _write_text(path, lines)
    library = []
    for name, colour in materials.items():
        library += [f"newmtl {name}", f"Kd {_row(colour)}", "Ka 0 0 0", "Ks 0 0 0", "d 1"]
        library += [f"map_Kd {stem}.png"] if image is not None else []
    _write_text(path.with_suffix(".mtl"), library)
    if image is not None:
        path.with_suffix(".png").write_bytes(png_bytes(image))


def write_ply(path: Path, mesh: Mesh, image: Image.Image) -> None:
    """Write `mesh` as binary PLY with texture coordinates and the PNG beside it that its comment names."""
    table, corners = _welded(np.concatenate([mesh.triangles, mesh.uv], axis=2))
    header = ["ply", "format binary_little_endian 1.0", f"comment TextureFile {path.stem}.png"]
    header += [f"element vertex {len(table)}", *(f"property float {name}" for name in "xyzst")]
    header += [f"element face {len(corners)}", "property list uchar int vertex_indices", "end_header", ""]
    faces = np.zeros(len(corners), dtype=[("count", "u1"), ("corner", "<i4", (3,))])
    faces["count"], faces["corner"] = 3, corners
    path.write_bytes("\n".join(header).encode() + table.astype("<f4").tobytes() + faces.tobytes())
    path.with_suffix(".png").write_bytes(png_bytes(image))


def write_stl(path: Path, triangles: FloatArray) -> None:
    """Write `triangles` as binary STL."""
    facets = np.zeros(len(triangles), dtype=[("normal", "<f4", (3,)), ("corner", "<f4", (3, 3)), ("rest", "<u2")])
    facets["normal"], facets["corner"] = _rounded(normals(triangles)), _rounded(triangles)
    path.write_bytes(b"popsim".ljust(80) + struct.pack("<I", len(triangles)) + facets.tobytes())


def write_text_stl(path: Path, triangles: FloatArray) -> None:
    """Write `triangles` as STL in text."""
    lines = [f"solid {path.stem}"]
    for normal, corners in zip(normals(triangles), triangles, strict=True):
        lines += [f"facet normal {_row(normal)}", "outer loop"]
        lines += [f"vertex {_row(corner)}" for corner in corners]
        lines += ["endloop", "endfacet"]
    _write_text(path, [*lines, f"endsolid {path.stem}"])


def write_off(path: Path, triangles: FloatArray) -> None:
    """Write `triangles` as OFF."""
    points, corners = _welded(triangles)
    lines = ["OFF", f"{len(points)} {len(corners)} 0", *(_row(p) for p in points)]
    _write_text(path, [*lines, *(f"3 {a} {b} {c}" for a, b, c in corners)])


def write_glb(path: Path, mesh: Mesh, image: Image.Image) -> None:
    """Write `mesh` as binary glTF 2.0 with flat normals and its picture inside, the picture last."""
    flat = np.repeat(normals(mesh.triangles)[:, None], 3, axis=1)
    downward = mesh.uv * [1, -1] + [0, 1]  # glTF counts v from the top
    table, corners = _welded(np.concatenate([mesh.triangles, flat, downward], axis=2))
    columns = table.astype("<f4")
    blocks = [columns[:, :3], columns[:, 3:6], columns[:, 6:], corners.astype("<u2").reshape(-1)]
    raw = [*(np.ascontiguousarray(block).tobytes() for block in blocks), png_bytes(image)]
    chunks = [_padded(chunk) for chunk in raw]
    starts = np.cumsum([0, *map(len, chunks)]).tolist()
    views = [
        {"buffer": 0, "byteOffset": start, "byteLength": len(chunk)}
        for start, chunk in zip(starts, raw, strict=False)
    ]
    for view, target in zip(views, (_VERTICES, _VERTICES, _VERTICES, _INDICES), strict=False):
        view["target"] = target
    header = _gltf(path.stem, blocks, views, starts[-1])
    head = _padded(json.dumps(header, separators=(",", ":")).encode(), b" ")
    body = b"".join(chunks)
    path.write_bytes(
        struct.pack("<4sII", b"glTF", 2, 28 + len(head) + len(body))
        + struct.pack("<I4s", len(head), b"JSON")
        + head
        + struct.pack("<I4s", len(body), b"BIN\0")
        + body
    )


def png_bytes(image: Image.Image) -> bytes:
    """Return `image` as a PNG file."""
    buffer = BytesIO()
    image.save(buffer, "PNG", compress_level=9)
    return buffer.getvalue()


def _gltf(name: str, blocks: list[npt.NDArray[np.generic]], views: list[dict[str, int]], size: int) -> object:
    """Header of a file with one textured mesh; blocks are positions, normals, texture coordinates, corners."""
    kinds = ("VEC3", "VEC3", "VEC2", "SCALAR")
    accessors: list[dict[str, object]] = [
        {"bufferView": i, "componentType": _USHORT if i == 3 else _FLOAT, "count": len(block), "type": kind}
        for i, (block, kind) in enumerate(zip(blocks, kinds, strict=True))
    ]
    accessors[0] |= {"min": _plain(blocks[0].min(axis=0)), "max": _plain(blocks[0].max(axis=0))}
    attributes = {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}
    surface = {"baseColorTexture": {"index": 0}, "metallicFactor": 0, "roughnessFactor": 1}
    return {
        "asset": {"version": "2.0", "generator": "popsim models/make_models.py"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 3, "material": 0}]}],
        "materials": [{"name": "paint", "pbrMetallicRoughness": surface}],
        "textures": [{"source": 0}],
        "images": [{"mimeType": "image/png", "bufferView": 4}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": size}],
    }


def _welded(corners: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return the different rows among corners (m, 3, k), sorted, and the index of each corner (m, 3)."""
    rows, index = np.unique(_rounded(corners).reshape(-1, corners.shape[2]), axis=0, return_inverse=True)
    return rows, index.reshape(-1, 3)


def _rounded(values: FloatArray) -> FloatArray:
    return np.asarray(values.round(_DIGITS) + 0.0, dtype=np.float64)  # + 0.0 turns -0.0 into 0.0


def _plain(values: npt.NDArray[np.generic]) -> list[float]:
    return [float(v) for v in values.tolist()]


def _row(values: npt.ArrayLike) -> str:
    return " ".join(
        f"{v:.{_DIGITS}f}".rstrip("0").rstrip(".") for v in _rounded(np.asarray(values, dtype=np.float64))
    )


def _padded(chunk: bytes, filler: bytes = b"\0") -> bytes:
    return chunk + filler * (-len(chunk) % 4)


def _write_text(path: Path, lines: list[str]) -> None:
    path.write_bytes(("\n".join(lines) + "\n").encode())
