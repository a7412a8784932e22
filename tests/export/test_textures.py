"""Pictures on paper."""

from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from popsim.errors import InputError
from popsim.export.textures import packed_texture, read_texture


def test_what_is_transparent_becomes_paper(tmp_path: Path) -> None:
    pixels = np.zeros((4, 4, 4), dtype=np.uint8)
    pixels[0, 0] = (255, 0, 0, 255)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    seen = np.asarray(read_texture(tmp_path, "a.png"))
    assert tuple(seen[0, 0]) == (255, 0, 0)
    assert tuple(seen[3, 3]) == (255, 255, 255)


def test_photographs_are_packed_and_drawings_are_exact(tmp_path: Path) -> None:
    noise = np.random.default_rng(0).normal(128, 12, (700, 700, 3))
    Image.fromarray(noise.clip(0, 255).astype(np.uint8)).save(tmp_path / "photo.png")
    Image.new("RGB", (700, 700), (10, 200, 30)).save(tmp_path / "flat.png")
    photo, kind = packed_texture(tmp_path, "photo.png")
    assert kind == "JPEG"
    error = np.asarray(Image.open(BytesIO(photo)), float) - noise
    assert np.abs(error).mean() < 6  # of 255, on noise, the worst there is
    flat, kind = packed_texture(tmp_path, "flat.png")
    assert kind == "PNG"
    assert (np.asarray(Image.open(BytesIO(flat))) == (10, 200, 30)).all()


def test_what_is_no_image_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_text("no image")
    with pytest.raises(InputError, match=r"a\.png"):
        read_texture(tmp_path, "a.png")
