"""The card closing and opening in pictures."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from folding_designs import mismatched_box, overlapping_boxes, plain_box
from PIL import Image

from popsim.design import Design
from popsim.errors import InputError, OutputError
from popsim.pictures.animation import (
    CLOSED,
    HELD,
    SHOWN,
    _marked,
    check_animation,
    first_to_cross,
    write_animation,
)
from popsim.pictures.look import Look
from popsim.pictures.moving import MovingPopup
from popsim.pictures.video import write_mp4
from popsim.verification import verify

TINY = Look(azimuth=14, elevation=28, width=96, height=72)


@pytest.fixture(scope="module")
def crossing(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("animation")
    return drawn(folder / "crossing.gif", overlapping_boxes())


def drawn(path: Path, design: Design) -> Path:
    write_animation(path, design, verify(design), path.parent, look=TINY, force=False)
    return path


def frames_of(path: Path) -> tuple[np.ndarray, list[int]]:
    """Pictures (n, h, w, 3) and for how many ms each is shown."""
    with Image.open(path) as image:
        pictures, times = [], []
        for index in range(image.n_frames):
            image.seek(index)
            pictures.append(np.asarray(image.convert("RGB"), dtype=int))
            times.append(image.info["duration"])
    return np.array(pictures), times


def red(picture: np.ndarray) -> int:
    """Number of pixels that are clearly red."""
    return int((picture[..., 0] > picture[..., 1:].max(axis=-1) + 40).sum())


def test_it_closes_and_opens_every_six_degrees(crossing):
    pictures, times = frames_of(crossing)
    assert pictures.shape == (60, 72, 96, 3)
    assert [index for index, time in enumerate(times) if time == HELD] == [0, 30]
    assert set(times) == {SHOWN, HELD}
    assert np.abs(pictures[1:] - pictures[:-1]).max(axis=(1, 2, 3)).min() > 0


def test_what_crosses_first_is_red_from_there_on(crossing):
    contacts = first_to_cross(verify(overlapping_boxes()))
    assert {"M.F_L", "N.B_L"} <= {name for contact in contacts for name in contact.patches}
    first = contacts[0].first
    pictures, _ = frames_of(crossing)
    angles = [*range(180, 0, -6), CLOSED, *range(6, 180, 6)]
    assert len(angles) == len(pictures)
    reds = [red(picture) for picture in pictures]
    apart = [count for angle, count in zip(angles, reds, strict=True) if angle > np.degrees(first) + 0.5]
    wide = [count for angle, count in zip(angles, reds, strict=True) if 50 < angle < np.degrees(first)]
    assert max(apart) == 0
    assert min(wide) > 10


def test_nothing_is_red_where_nothing_crosses(tmp_path):
    design = plain_box()
    assert first_to_cross(verify(design)) == ()
    pictures, _ = frames_of(drawn(tmp_path / "box.png", design))
    assert max(red(picture) for picture in pictures) == 0


def test_gif_has_one_palette_and_is_the_same_every_time(crossing, tmp_path):
    assert drawn(tmp_path / "again.gif", overlapping_boxes()).read_bytes() == crossing.read_bytes()
    with Image.open(crossing) as image:
        for index in range(image.n_frames):
            image.seek(index)
            assert not any(kind == "local" for kind, *_ in image.tile)


def test_webp_moves_too_also_for_what_does_not_fold(tmp_path):
    pictures, _ = frames_of(drawn(tmp_path / "broken.webp", mismatched_box(2)))
    assert len(pictures) == 60


def test_what_crosses_while_opening_is_red_from_there_on(crossing):
    verdict = verify(overlapping_boxes())
    sweep, contact = verdict.evidence.sweep, first_to_cross(verdict)[0]
    late = replace(contact, way="opening", frame=sweep.closed + 30)
    assert _marked([late], sweep, sweep.closed + 29) == frozenset()
    assert _marked([late], sweep, sweep.closed + 30) == set(late.patches)
    assert _marked([contact], sweep, contact.frame - 1) == frozenset()
    assert _marked([contact], sweep, sweep.closed) == set(contact.patches)


def test_a_film_shows_what_the_gif_shows_and_is_the_same_every_time(tmp_path):
    imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg")
    films = [drawn(tmp_path / name, overlapping_boxes()) for name in ("one.mp4", "two.mp4")]
    assert films[0].read_bytes() == films[1].read_bytes()
    reader = imageio_ffmpeg.read_frames(str(films[0]))
    about = next(reader)
    pictures = [np.frombuffer(frame, np.uint8).reshape(72, 96, 3).astype(int) for frame in reader]
    held = round(HELD / SHOWN)
    assert about["size"] == (96, 72)
    assert about["fps"] == pytest.approx(1000 / SHOWN, abs=0.01)
    assert len(pictures) == 58 + 2 * held
    assert red(pictures[0]) == 0
    assert max(red(picture) for picture in pictures) > 10


def test_sides_of_odd_length_lose_a_pixel(tmp_path):
    imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg")
    pictures = [Image.new("RGB", (33, 21), colour) for colour in ("white", "black")]
    write_mp4(tmp_path / "odd.mp4", pictures, [70, 140])
    reader = imageio_ffmpeg.read_frames(str(tmp_path / "odd.mp4"))
    assert next(reader)["size"] == (32, 20)
    assert [np.frombuffer(frame, np.uint8).mean() > 128 for frame in reader] == [True, False, False]


def test_a_film_without_encoder_names_the_extra_before_any_work(monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(InputError, match=r"popsim\[video\].*\.gif"):
        check_animation(Path("card.mp4"))


def test_other_formats_and_existing_files_are_refused(crossing):
    design = plain_box()
    verdict = verify(design)
    with pytest.raises(InputError, match=r"\.gif, \.webp"):
        write_animation(crossing.with_suffix(".avi"), design, verdict, crossing.parent, force=False)
    with pytest.raises(OutputError, match="--force"):
        write_animation(crossing, design, verdict, crossing.parent, look=TINY, force=False)


def test_poses_move_their_own_patch_alone():
    design = plain_box()
    popup = MovingPopup(design, Path())
    still = np.tile(np.eye(4), (len(design.patches), 1, 1))
    moved = still.copy()
    moved[-1, :3, 3] = [0, 0, 7]
    before, after = popup.posed(still).triangles, popup.posed(moved).triangles
    shift = (after - before).reshape(-1, 9)
    corners = len(design.patches[-1].outline) - 2
    assert np.count_nonzero(shift.any(axis=1)) == 2 * corners
    assert shift[-1] == pytest.approx(np.tile([0, 0, 7], 3))
