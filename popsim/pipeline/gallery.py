"""A gallery: models beside their open pop-ups, in the same view, on one sheet."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from popsim.errors import InputError, PopsimError
from popsim.geometry.arrays import UInt8Array
from popsim.mesh.formats import FORMATS
from popsim.patches import PatchSettings
from popsim.pictures import Look, beside
from popsim.pipeline.run import run_design
from popsim.pipeline.settings import RunSettings

LOOK = Look(azimuth=35.0, elevation=24.0, width=272, height=220)
"""Of each picture."""

SETTINGS = RunSettings(patches=PatchSettings(dpi=120.0))
"""As a user gets it without options; prints are as fine as the pictures show."""


@dataclass(frozen=True, eq=False)
class Exhibit:
    """A model of a gallery.

    Attributes
    ----------
    path:
        Its file.
    picture:
        The model beside its open pop-up, RGBA, shape (h, w, 4); None where no pop-up could be made.
    caption:
        What stands below: its name, the number of patches, whether it folds, or why there is none.
    """

    path: Path
    picture: UInt8Array | None
    caption: str


def find_models(places: Sequence[Path]) -> list[Path]:
    """Model files: those named, and all in folders named, in the order of the places, then of their names.

    Raises
    ------
    InputError
        A place does not exist, or there is no model at any.
    """
    found: list[Path] = []
    for place in places:
        if not place.exists():
            raise InputError(f"{place} does not exist; give model files or folders that hold some")
        inside = sorted(place.rglob("*")) if place.is_dir() else [place]
        found += [path for path in inside if place.is_file() or path.suffix.lower() in FORMATS]
    if not found:
        raise InputError(f"no model in {', '.join(map(str, places))}; its name must end in {', '.join(FORMATS)}")
    return list(dict.fromkeys(found))


def exhibit(path: Path, look: Look = LOOK, settings: RunSettings = SETTINGS) -> Exhibit:
    """Design a pop-up of a model and draw both; a model that cannot be folded is an exhibit without picture."""
    try:
        run = run_design(path, settings)
        picture = beside(run.design, run.painted.images, run.prepared.surface, look)
    except PopsimError as error:
        return Exhibit(path, None, f"{path.stem}: {error}")
    folds = "" if run.verdict.passed else ", does not fold"
    return Exhibit(path, picture, f"{path.stem}: {len(run.design.popup_patches)} patches{folds}")


def exhibits(paths: Sequence[Path], jobs: int = -1) -> Iterator[Exhibit]:
    """The exhibits of models, in their order; `jobs` processes work on them, -1 takes one for each core."""
    if jobs == 0:
        raise InputError("a gallery needs processes to make it; give --jobs 1 or more, or -1 for all cores")
    if jobs == 1 or len(paths) == 1:
        yield from map(exhibit, paths)
        return
    from joblib import Parallel, delayed

    yield from Parallel(n_jobs=jobs, return_as="generator")(delayed(exhibit)(path) for path in paths)


def hang(shown: Sequence[Exhibit], columns: int) -> UInt8Array:
    """Put exhibits with pictures on one sheet, RGBA.

    Raises
    ------
    InputError
        None has a picture.
    """
    from popsim.rendering.contact_sheet import contact_sheet

    hung = [(each.picture, each.caption) for each in shown if each.picture is not None]
    if not hung:
        raise InputError("no pop-up could be made of any of these models; design one alone to see why")
    return contact_sheet([picture for picture, _ in hung], [caption for _, caption in hung], columns)
