"""GLB (glTF 2.0) of a design with its folding as an animation.

One node per patch under one root, which turns the card frame (z up, mm) to that of glTF (y up, m). A patch is two
primitives, its printed and its bare side, each seen from its own side alone. Translation and rotation of each node
are keyed at every fold angle; between them viewers turn evenly. The root's `extras` say which angles those are.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np

from popsim.export.solid.scene import Leaf, Scene
from popsim.export.textures import packed_texture
from popsim.geometry.arrays import FloatArray
from popsim.geometry.rigid import transform

SECONDS = 4.0
"""How long the card takes to close, and again to open."""

METRES = 1e-3

FLOAT, UINT = 5126, 5125
"""Component types of glTF."""

ARRAY, ELEMENTS = 34962, 34963
"""Targets of buffer views: vertices, indices."""


def write_glb(scene: Scene, path: Path) -> tuple[Path, ...]:
    """Write all leaves; they move if `scene` has several fold angles. The same scene gives the same bytes."""
    document = _Document()
    for number, leaf in enumerate(scene.leaves):
        document.add_leaf(leaf, scene.poses[:, number], scene.textures)
    path.write_bytes(document.content(scene.degrees))
    return (path,)


class _Document:
    """A glTF document that grows leaf by leaf, and its binary buffer."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._data: dict[str, list[Any]] = {
            name: [] for name in ("bufferViews", "accessors", "meshes", "materials", "images", "textures", "nodes")
        }
        self._channels: list[dict[str, Any]] = []
        self._samplers: list[dict[str, Any]] = []
        self._times: int | None = None

    def add_leaf(self, leaf: Leaf, poses: FloatArray, textures: Path) -> None:
        """Add a patch with its poses (n, 4, 4), the first of which is where it stands."""
        centre = leaf.corners.reshape(-1, 3).mean(axis=0)
        mesh = self._add("meshes", {"name": leaf.name, "primitives": self._sides(leaf, centre, textures)})
        places = transform(poses, centre[None])[:, 0]
        turns = _quaternions(poses[:, :3, :3])
        node = {
            "name": leaf.name,
            "mesh": mesh,
            "translation": _plain(places[0]),
            "rotation": _plain(turns[0]),
        }
        number = self._add("nodes", node)
        if len(poses) > 1:
            times = self._keys(len(poses))
            for track, values, kind in (("translation", places, "VEC3"), ("rotation", turns, "VEC4")):
                sampler = {"input": times, "output": self._accessor(values, kind), "interpolation": "LINEAR"}
                self._samplers.append(sampler)
                target = {"node": number, "path": track}
                self._channels.append({"sampler": len(self._samplers) - 1, "target": target})

    def content(self, degrees: FloatArray) -> bytes:
        """The file: header, JSON chunk, binary chunk."""
        root: dict[str, Any] = {
            "name": "card",
            "children": list(range(len(self._data["nodes"]))),
            "rotation": [-(0.5**0.5), 0.0, 0.0, 0.5**0.5],
            "scale": [METRES] * 3,
        }
        data: dict[str, Any] = {"asset": {"version": "2.0", "generator": "popsim"}, "scene": 0}
        data |= {name: entries for name, entries in self._data.items() if entries}
        data["nodes"] = [*self._data["nodes"], root]
        data["scenes"] = [{"nodes": [len(self._data["nodes"])]}]
        if self._channels:
            data["animations"] = [{"name": "fold", "channels": self._channels, "samplers": self._samplers}]
            root["extras"] = {"fold_angles": _plain(degrees)}
        data["buffers"] = [{"byteLength": len(self._buffer)}]
        text = json.dumps(data, allow_nan=False, separators=(",", ":")).encode()
        chunks = _chunk(b"JSON", text, b" ") + _chunk(b"BIN\0", bytes(self._buffer), b"\0")
        return b"glTF" + np.array([2, 12 + len(chunks)], dtype="<u4").tobytes() + chunks

    def _sides(self, leaf: Leaf, centre: FloatArray, textures: Path) -> list[dict[str, Any]]:
        corners = (leaf.corners - centre).reshape(-1, 3)
        normal = np.cross(leaf.corners[0, 1] - leaf.corners[0, 0], leaf.corners[0, 2] - leaf.corners[0, 0])
        normal /= np.linalg.norm(normal)
        position = self._accessor(corners, "VEC3", bounds=True, target=ARRAY)
        uv = leaf.uv.reshape(-1, 2) * [1.0, -1.0] + [0.0, 1.0]  # glTF counts v from the top
        indices = np.arange(len(corners), dtype="<u4")
        sides = []
        for sign, colour, texture in ((1.0, leaf.front, leaf.texture), (-1.0, leaf.back, None)):
            attributes = {
                "POSITION": position,
                "NORMAL": self._accessor(np.tile(sign * normal, (len(corners), 1)), "VEC3", target=ARRAY),
            }
            if texture is not None:
                attributes["TEXCOORD_0"] = self._accessor(uv, "VEC2", target=ARRAY)
            order = indices if sign > 0 else indices.reshape(-1, 3)[:, ::-1].ravel()
            sides.append(
                {
                    "attributes": attributes,
                    "indices": self._accessor(order, "SCALAR", kind=UINT, target=ELEMENTS),
                    "material": self._material(colour, texture, textures),
                }
            )
        return sides

    def _material(self, colour: FloatArray, texture: str | None, textures: Path) -> int:
        look: dict[str, Any] = {
            "baseColorFactor": [*_plain(colour), 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 1.0,
        }
        if texture is not None:
            content, kind = packed_texture(textures, texture)
            image = {"bufferView": self._view(content), "mimeType": f"image/{kind.lower()}"}
            look["baseColorTexture"] = {"index": self._add("textures", {"source": self._add("images", image)})}
        material = {"pbrMetallicRoughness": look}
        known = self._data["materials"]
        return known.index(material) if material in known else self._add("materials", material)

    def _keys(self, frames: int) -> int:
        """Accessor of the times of the keys, one for all tracks."""
        if self._times is None:
            seconds = np.linspace(0.0, 2 * SECONDS, frames)[:, None]
            self._times = self._accessor(seconds, "SCALAR", bounds=True)
        return self._times

    def _accessor(
        self, values: Any, shape: str, *, kind: int = FLOAT, bounds: bool = False, target: int | None = None
    ) -> int:
        array = np.ascontiguousarray(values, dtype="<u4" if kind == UINT else "<f4")
        view = self._view(array.tobytes(), target)
        accessor = {"bufferView": view, "componentType": kind, "count": len(array), "type": shape}
        if bounds:
            accessor |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        return self._add("accessors", accessor)

    def _view(self, content: bytes, target: int | None = None) -> int:
        self._buffer += b"\0" * (-len(self._buffer) % 4)
        view = {"buffer": 0, "byteOffset": len(self._buffer), "byteLength": len(content)}
        self._buffer += content
        return self._add("bufferViews", view | ({"target": target} if target else {}))

    def _add(self, name: str, entry: dict[str, Any]) -> int:
        self._data[name].append(entry)
        return len(self._data[name]) - 1


def _quaternions(turns: FloatArray) -> FloatArray:
    """Unit quaternions (x, y, z, w) of rotation matrices (n, 3, 3), each on the side of the one before."""
    from scipy.spatial.transform import Rotation

    found = Rotation.from_matrix(turns).as_quat()
    for k in range(1, len(found)):
        if found[k] @ found[k - 1] < 0:
            found[k] = -found[k]
    return np.asarray(found)


def _chunk(kind: bytes, content: bytes, filler: bytes) -> bytes:
    padded = content + filler * (-len(content) % 4)
    return np.uint32(len(padded)).tobytes() + kind + padded


def _plain(values: FloatArray) -> list[float]:
    """Numbers for JSON, at a millionth."""
    return [float(value) for value in np.round(values, 6) + 0.0]
