"""Options of `popsim design` that must be weighed against each other."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from popsim.errors import InputError

if TYPE_CHECKING:
    from popsim.fitting import Weights, Wishes
    from popsim.mesh.alignment import Fold
    from popsim.pipeline.prepare import Scale
    from popsim.pipeline.wishes import Hand

USUAL_SIZE = 150.0
"""mm; longest side of a model where nothing is said of it."""

SAME = 1e-6
"""mm; sizes that differ by less are one."""


def read_hand(path: Path | None) -> "Hand":
    """Return what the user's wishes file says; nothing where there is none."""
    from popsim.pipeline.wishes import Hand, load_wishes

    return Hand() if path is None else load_wishes(path)


def chosen_size(size: str | None, scale: str | None, hand: "Hand") -> tuple["float | Scale", bool]:
    """Return the size of the model, and whether it may not be made smaller.

    Raises
    ------
    InputError
        An option is no size, or two of --size, --scale and --wishes state different ones.
    """
    from popsim.pipeline.prepare import Scale
    from popsim.units import parse_length, parse_scale

    if size is not None and scale is not None:
        raise InputError("--size and --scale both say how large the model shall be; give one of them")
    stated = None if size is None else parse_length(size, "--size")
    if hand.size is not None:
        if scale is not None or (stated is not None and abs(stated - hand.size) > SAME):
            raise InputError(
                f"the wishes are stated for a model of {hand.size:g} mm; leave out --size and --scale, or change "
                "them in the wishes, with all lengths there"
            )
        return hand.size, True
    if scale is not None:
        return Scale(parse_scale(scale, "--scale")), True
    return (USUAL_SIZE, False) if stated is None else (stated, True)


def chosen_fold(option: "Fold", hand: "Hand") -> "Fold":
    """Return the side along which the fold runs; InputError where --fold and --wishes state different ones."""
    if hand.fold is None or option == hand.fold:
        return option
    if option != "auto":
        raise InputError(
            f"the wishes are stated for a fold along the {hand.fold} side; leave out --fold, or change it there, "
            "with all that is stated in the card's frame"
        )
    return hand.fold


def most_patches(option: int | None, hand: "Hand") -> int:
    """Return the limit of the option, else of the wishes, else the usual one."""
    from popsim.fitting import FitSettings

    stated = hand.most_patches if option is None else option
    return FitSettings().most_patches if stated is None else stated


def parse_weights(text: str) -> "Weights":
    """Return the weights of Eq. 1; InputError where they are not three numbers that add up to 1."""
    from popsim.fitting import Weights

    try:
        outliers, distance, coverage = (float(word) for word in text.split(","))
    except ValueError:
        raise InputError(f"--weights: expected three numbers as 0.5,0.3,0.2, found '{text}'") from None
    return Weights(outliers, distance, coverage)


def chosen_wishes(hand: "Hand", forbid: Sequence[str]) -> "Wishes":
    """Return the wishes of the file and of --forbid; InputError for an unknown mechanism, or if none is left."""
    from popsim.pipeline.wishes import forbidden_types

    both = hand.wishes.forbidden | forbidden_types(forbid, "--forbid")
    return replace(hand.wishes, forbidden=forbidden_types(both, "--forbid"))
