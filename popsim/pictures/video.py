"""Pictures as an MP4 film, by the encoder that the extra `video` brings."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from popsim.errors import InputError

if TYPE_CHECKING:
    from PIL.Image import Image

QUALITY = ["-crf", "18", "-preset", "slow"]
"""Of H.264: lines stay sharp."""

SAME_BYTES = ["-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags", "+faststart"]
"""Nothing of the machine goes into the file: the same pictures give the same film. It plays while it loads."""


def require_encoder(path: Path) -> None:
    """Raise InputError where the encoder is not installed; `path` is what was to be written."""
    try:
        import imageio_ffmpeg  # noqa: F401  # whether it is there
    except ImportError:
        raise InputError(
            f"{path.name} needs an encoder; pip install 'popsim[video]' brings it, or write .gif, .webp or .png"
        ) from None


def write_mp4(path: Path, pictures: Sequence["Image"], times: Sequence[int]) -> None:
    """Write RGB pictures of one size, each shown for so many ms.

    The shortest time is that of one picture of the film; the others are shown for the nearest multiple of it.
    Sides of odd length lose a pixel, which H.264 asks for.
    """
    from imageio_ffmpeg import write_frames

    tick = min(times)
    width, height = (side - side % 2 for side in pictures[0].size)
    film = write_frames(
        str(path),
        (width, height),
        fps=1000 / tick,
        macro_block_size=2,
        quality=None,
        ffmpeg_log_level="error",
        output_params=[*QUALITY, *SAME_BYTES],
    )
    film.send(None)
    for picture, time in zip(pictures, times, strict=True):
        pixels = picture.crop((0, 0, width, height)).tobytes()
        for _ in range(round(time / tick)):
            film.send(pixels)
    film.close()
