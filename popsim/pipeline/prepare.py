"""The model on the card: aligned, scaled to millimetres, standing over the fold."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.geometry.surface import Surface

if TYPE_CHECKING:
    from popsim.mesh.alignment import Alignment, Fold
    from popsim.mesh.model import Model


@dataclass(frozen=True, eq=False)
class Prepared:
    """A model and where it stands.

    Attributes
    ----------
    model, alignment:
        As loaded, and as aligned.
    to_card:
        Model coordinates to card frame, shape (4, 4).
    surface:
        In the card frame, mm.
    bounds:
        What counts of it, rows low and high, mm, shape (2, 3).
    """

    model: "Model"
    alignment: "Alignment"
    to_card: FloatArray
    surface: Surface
    bounds: FloatArray

    def scaled(self, factor: float) -> "Prepared":
        """The same model `factor` times as large."""
        grow = np.diag([factor, factor, factor, 1.0])
        return Prepared(
            self.model,
            self.alignment,
            grow @ self.to_card,
            self.surface.transformed(grow),
            self.bounds * factor,
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


def prepare(path: Path, stance: Stance, size: float, seed: int) -> Prepared:
    """Load a model, align it, and scale its longest side to `size` mm.

    Raises
    ------
    MeshError
        The file is no model, or holds nothing to fold.
    """
    from popsim.mesh.alignment import align
    from popsim.mesh.loading import load_model

    model = load_model(path)
    alignment = align(model, up=stance.up, front=stance.front, method=stance.align, fold=stance.fold, seed=seed)
    aligned = Prepared(
        model, alignment, alignment.matrix, model.surface.transformed(alignment.matrix), alignment.box.bounds
    )
    return aligned.scaled(size / float(np.ptp(alignment.box.bounds, axis=0).max()))
