"""The card closing and opening, as simulated."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from popsim.design import Design, Patch
from popsim.errors import InputError
from popsim.files import write_file
from popsim.geometry.arrays import FloatArray, IntArray
from popsim.pictures.look import Look
from popsim.pictures.moving import MovingPopup
from popsim.pictures.video import require_encoder, write_mp4
from popsim.simulation.contact import Contact
from popsim.simulation.sweep import Sweep
from popsim.verification import Verdict

if TYPE_CHECKING:
    from PIL.Image import Image

    from popsim.rendering.camera import Camera

FILM = ".mp4"
"""Suffix of what is encoded by the extra `video`."""

FORMATS = {".gif": "GIF", ".webp": "WEBP", ".png": "PNG", ".apng": "PNG", FILM: FILM}
"""What Pillow calls the formats that move; films it does not write."""

STEP = 6.0
"""Degrees of fold angle between two pictures."""

CLOSED = 1.0
"""Degrees; at 0 everything lies in one plane, and no picture can tell what is in front."""

NEAR = 0.01
"""Degrees; a recorded angle is as good as one that is nearer than this."""

SHOWN, HELD = 70, 900
"""ms; how long a picture is shown, and how long the open and the closed card are."""

SAME = 0.05
"""mm; poses nearer to each other than this share their picture."""

PALETTE_FROM = 8
"""Pictures from which the colours of a GIF are chosen."""

INK = (90, 90, 90)
"""Of the fold angle in the corner."""

AROUND = 0.4
"""How much of the pages is seen around the pop-up, of its size."""

SMALL = Look(azimuth=14, elevation=28, width=480, height=360)
"""Of an animation, unless told otherwise: into the closing card, between its pages."""


def check_animation(path: Path) -> None:
    """Raise InputError where `path` has no suffix that :func:`write_animation` knows, or no encoder for it."""
    if path.suffix.lower() not in FORMATS:
        known = ", ".join(FORMATS)
        raise InputError(f"an animation is written as {known}, not {path.suffix or 'without a suffix'}")
    if path.suffix.lower() == FILM:
        require_encoder(path)


def write_animation(
    path: Path, design: Design, verdict: Verdict, textures: Path, *, look: Look = SMALL, force: bool
) -> None:
    """Draw the recorded motion; patches that are the first to cross are red from there on.

    Parameters
    ----------
    path:
        GIF, WebP, PNG (APNG) or MP4 to write.
    design, verdict:
        What was folded and found.
    textures:
        The folder its texture paths are relative to.
    look:
        View and size.
    force:
        Overwrite an existing file.

    Raises
    ------
    InputError
        The suffix is unknown, its encoder is not installed, or a texture cannot be read.
    OutputError
        The file exists and `force` is false, or cannot be written.
    """
    check_animation(path)
    name = FORMATS[path.suffix.lower()]
    sweep = verdict.evidence.sweep
    frames = _frames(sweep)
    pictures = list(_pictures(design, verdict, frames, textures, look))
    ends = (frames[0], min(frames, key=lambda frame: sweep.theta[frame]))
    times = [HELD if frame in ends else SHOWN for frame in frames]
    if name == FILM:
        write_file(path, lambda temporary: write_mp4(temporary, pictures, times), force=force)
        return
    if name == "GIF":
        pictures = _with_one_palette(pictures)
    first, *others = pictures
    write_file(
        path,
        lambda temporary: first.save(
            temporary, format=name, save_all=True, append_images=others, duration=times, loop=0
        ),
        force=force,
    )


def first_to_cross(verdict: Verdict) -> tuple[Contact, ...]:
    """The contacts that begin at the earliest recorded angle, while closing or, if none do then, while opening."""
    contacts = verdict.evidence.contacts
    earliest = min((contact.frame for contact in contacts), default=-1)
    return tuple(contact for contact in contacts if contact.frame == earliest)


def _frames(sweep: Sweep) -> list[int]:
    """Recorded angles to draw, closing and opening; none twice in a row, also where it starts again."""
    closing = _every_step(sweep, np.arange(sweep.closed + 1))
    opening = _every_step(sweep, np.arange(sweep.closed, len(sweep.theta)))
    return [*closing, *opening[1:-1]]


def _every_step(sweep: Sweep, among: IntArray) -> list[int]:
    """Those of the recorded angles that are nearest to the wanted ones, in their order."""
    degrees = sweep.degrees[among]
    wanted = [CLOSED, *np.arange(STEP, 180.0 + NEAR, STEP)]
    inside = [angle for angle in wanted if degrees.min() - NEAR < angle < degrees.max() + NEAR]
    return sorted({int(among[np.abs(degrees - angle).argmin()]) for angle in inside})


def _pictures(
    design: Design, verdict: Verdict, frames: Sequence[int], textures: Path, look: Look
) -> Iterator["Image"]:
    """One RGB picture per frame; where the card opens through the same poses, those from closing again."""
    sweep = verdict.evidence.sweep
    popup, camera = MovingPopup(design, textures), _camera(sweep, frames, look)
    contacts = first_to_cross(verdict)
    drawn: dict[int, Image] = {}
    marks: dict[int, frozenset[str]] = {}
    for frame in frames:
        marks[frame] = _marked(contacts, sweep, frame)
        alike = [other for other in drawn if marks[other] == marks[frame]]
        twin = min(alike, key=lambda other: abs(sweep.theta[other] - sweep.theta[frame]), default=None)
        if twin is None or _apart(sweep, twin, frame) > SAME:
            twin = frame
            drawn[frame] = _picture(popup, sweep.poses[frame], marks[frame], camera, look)
        yield _captioned(drawn[twin], f"{sweep.degrees[frame]:.0f}°")


def _marked(contacts: Sequence[Contact], sweep: Sweep, frame: int) -> frozenset[str]:
    """Patches that are red at a recorded angle.

    What crosses while closing does so below that angle, on either way; what crosses while opening, from there on.
    """
    return frozenset(
        name
        for contact in contacts
        for name in contact.patches
        if (sweep.theta[frame] <= contact.first if contact.way == "closing" else frame >= contact.frame)
    )


def _picture(
    popup: MovingPopup, poses: FloatArray, marked: frozenset[str], camera: "Camera", look: Look
) -> "Image":
    from PIL import Image

    from popsim.rendering.picture import render_picture

    surface = popup.posed(poses, marked)
    pixels = render_picture(surface, camera, (look.width, look.height), shadows=False, lines=True).pixels
    return Image.fromarray(pixels).convert("RGB")


def _camera(sweep: Sweep, frames: Sequence[int], look: Look) -> "Camera":
    """One camera that sees the whole motion of the pop-up, and of the pages what is around it."""
    from popsim.rendering.camera import Camera

    whole = _box(sweep, frames, sweep.design.patches)
    inner = _box(sweep, frames, sweep.design.popup_patches or sweep.design.patches)
    reserve = AROUND * float(np.ptp(inner, axis=0).max())
    bounds = [np.maximum(inner[0] - reserve, whole[0]), np.minimum(inner[1] + reserve, whole[1])]
    return Camera.looking_at(bounds, look.azimuth, look.elevation, aspect=look.width / look.height)


def _box(sweep: Sweep, frames: Sequence[int], patches: Sequence[Patch]) -> FloatArray:
    """Lowest and highest corner of what `patches` sweep, shape (2, 3)."""
    moved = np.concatenate([sweep.moved(patch.id)[frames].reshape(-1, 3) for patch in patches])
    return np.array([moved.min(axis=0), moved.max(axis=0)])


def _apart(sweep: Sweep, one: int, other: int) -> float:
    """Greatest distance of any corner in two recorded poses, mm."""
    shifts = [
        np.linalg.norm(np.diff(sweep.moved(name)[[one, other]], axis=0), axis=-1).max() for name in sweep.index
    ]
    return float(max(shifts))


def _captioned(picture: "Image", words: str) -> "Image":
    from PIL import ImageDraw, ImageFont

    picture = picture.copy()
    size = max(10, picture.height // 20)
    ImageDraw.Draw(picture).text((size // 2, size // 2), words, INK, ImageFont.load_default(size))
    return picture


def _with_one_palette(pictures: Sequence["Image"]) -> list["Image"]:
    """The pictures in 256 colours, chosen from some of them spread over the whole motion."""
    from PIL import Image

    width, height = pictures[0].size
    sample = Image.new("RGB", (width, PALETTE_FROM * height))
    for place, index in enumerate(np.linspace(0, len(pictures) - 1, PALETTE_FROM).astype(int)):
        sample.paste(pictures[index], (0, place * height))
    palette = sample.quantize(256, Image.Quantize.MEDIANCUT)
    return [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
