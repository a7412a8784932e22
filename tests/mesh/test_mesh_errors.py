"""Whatever cannot be used is refused in one clear line."""

import struct
from pathlib import Path

import pytest

from popsim.errors import InputError, MeshError
from popsim.mesh.formats import FORMATS
from popsim.mesh.loading import load_model

TEXT = b"Dear reader, this is not a model.\n" * 5
VERTICES = b"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\n"
STL_HEADER = b"\0" * 80

CASES = {
    "empty.obj": (b"", "empty"),
    "empty.glb": (b"", "empty"),
    "blank.obj": (b" \n\n", "empty"),
    "text.obj": (TEXT, "no faces"),
    "point.obj": (b"v 1 2 3\n", "no faces"),
    "points.obj": (VERTICES, "no faces"),
    "line.obj": (VERTICES + b"f 1 2 3\n", "one line"),
    "same.obj": (b"v 1 1 1\n" * 3 + b"f 1 2 3\n", "coincide"),
    "undefined.obj": (b"v nan 0 0\n" * 3 + b"f 1 2 3\n", "not numbers"),
    "huge.obj": (b"v -1e308 0 0\nv 1e308 0 0\nv 0 1e308 0\nf 1 2 3\n", "too far"),
    "index.obj": (VERTICES + b"f 1 2 99\n", "damaged"),
    "none.stl": (STL_HEADER + struct.pack("<I", 0), "no faces"),
    "cut.stl": (STL_HEADER + struct.pack("<I", 9) + b"\0" * 60, "no faces"),
    "none.off": (b"OFF\n0 0 0\n", "no faces"),
    "cloud.ply": (
        b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        b"end_header\n0 0 0\n",
        "no faces",
    ),
    "none.gltf": (b'{"asset": {"version": "2.0"}}', "no faces"),
    "lost.gltf": (
        b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "lost.bin", "byteLength": 3}]}',
        "'lost.bin'",
    ),
    "model.step": (TEXT, "expected one of .obj .stl"),
    "model": (TEXT, "expected one of .obj .stl"),
} | {f"text{suffix}": (TEXT, f"text{suffix}") for suffix in FORMATS if suffix != ".obj"}


@pytest.mark.parametrize("name", CASES)
def test_refused_in_one_line(name: str, tmp_path: Path) -> None:
    data, words = CASES[name]
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(MeshError) as caught:
        load_model(path)
    message = str(caught.value)
    assert words in message
    assert name in message
    assert "\n" not in message
    assert len(message) < 250


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"nowhere\.obj does not exist"):
        load_model(tmp_path / "nowhere.obj")


def test_folder(tmp_path: Path) -> None:
    folder = tmp_path / "folder.obj"
    folder.mkdir()
    with pytest.raises(InputError, match="is a folder"):
        load_model(folder)
