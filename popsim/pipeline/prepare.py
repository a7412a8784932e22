"""The model on the card: aligned, scaled to millimetres, standing over the fold."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from popsim.errors import InputError
from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Surface
from popsim.rendering.ray_scene import RayScene

if TYPE_CHECKING:
    from popsim.mesh.alignment import Alignment, Fold
    from popsim.mesh.model import Model

SMALLEST, LARGEST = 20.0, 2000.0
"""mm; a longest side outside this is a mistake in units rather than a wish."""


@dataclass(frozen=True)
class Scale:
    """The size of a model stated by its scale: `ratio` mm on the card for each mm of the thing itself."""

    ratio: float

    def __str__(self) -> str:
        inverse = 1 / self.ratio
        return f"1:{inverse:g}" if abs(inverse - round(inverse)) < 1e-9 * inverse else f"{self.ratio:g}"


@dataclass(frozen=True, eq=False)
class Prepared:
    """A model and where it stands.

    Attributes
    ----------
    model, alignment:
        As loaded, and as aligned.
    to_card:
        Model coordinates to card frame, shape (4, 4).
    scene:
        The model in the card frame, mm, for rays.
    bounds:
        What counts of it, rows low and high, mm, shape (2, 3).
    """

    model: "Model"
    alignment: "Alignment"
    to_card: FloatArray
    scene: RayScene
    bounds: FloatArray

    @property
    def surface(self) -> Surface:
        """In the card frame, mm."""
        return self.scene.surface

    @property
    def longest(self) -> float:
        """Longest side of what counts, mm."""
        return float(np.ptp(self.bounds, axis=0).max())

    def scaled(self, factor: float) -> "Prepared":
        """The same model `factor` times as large."""
        grow = np.diag([factor, factor, factor, 1.0])
        return Prepared(
            self.model, self.alignment, grow @ self.to_card, self.scene.scaled(factor), self.bounds * factor
        )


@dataclass(frozen=True)
class Stance:
    """How the user wants the model to stand; see :func:`popsim.mesh.alignment.align`."""

    up: str = "auto"
    front: str | None = None
    align: str = "npca"
    fold: "Fold" = "auto"

    def __post_init__(self) -> None:
        from popsim.mesh.alignment import check_options

        check_options(self.up, self.front, self.align, self.fold)


def prepare(path: Path, stance: Stance, size: float | Scale, seed: int) -> Prepared:
    """Load a model, align it, and bring it to a size: its longest side in mm, or a scale.

    Raises
    ------
    MeshError
        The file is no model, or holds nothing to fold.
    InputError
        The scale makes it no pop-up: too small to cut, or larger than any table.
    """
    return next(_prepared(path, stance, size, seed))


def prepare_ways(path: Path, stance: Stance, size: float | Scale, seed: int) -> tuple[Prepared, ...]:
    """The same, and with the fold along the other side where that is as good a guess, for fitting to choose."""
    return tuple(_prepared(path, stance, size, seed))


def _prepared(path: Path, stance: Stance, size: float | Scale, seed: int) -> Iterator[Prepared]:
    from popsim.mesh.alignment import alignments
    from popsim.mesh.loading import load_model

    model = load_model(path)
    for alignment in alignments(
        model, up=stance.up, front=stance.front, method=stance.align, fold=stance.fold, seed=seed
    ):
        longest = float(np.ptp(alignment.box.bounds, axis=0).max())
        factor = size.ratio * model.unit if isinstance(size, Scale) else size / longest
        if isinstance(size, Scale):
            what = f"at a scale of {size} the model, {longest:g} units of {model.unit:g} mm long, has {{}}"
            check_size(longest * factor, what)
        to_card = np.diag([factor, factor, factor, 1.0]) @ alignment.matrix
        scene = RayScene(model.surface.transformed(to_card))
        yield Prepared(model, alignment, to_card, scene, alignment.box.bounds * factor)


def check_size(longest: float, what: str = "size: {}") -> None:
    """Raise InputError for a longest side, mm, that is a mistake in units; `what` says where it comes from."""
    if not SMALLEST <= longest <= LARGEST:
        found = what.format(f"{longest:.0f} mm" if longest >= SMALLEST else f"{longest:.3g} mm")
        raise InputError(f"{found}; expected {SMALLEST:g} to {LARGEST:g} mm")
