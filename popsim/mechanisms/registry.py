"""The list of all mechanisms."""

from popsim.errors import DesignError
from popsim.mechanisms.base import Mechanism
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.mechanisms.v_fold_1 import VFold1
from popsim.mechanisms.v_fold_2 import VFold2


def _registry(*kinds: type[Mechanism]) -> dict[str, type[Mechanism]]:
    named = {kind.type: kind for kind in kinds}
    if len(named) != len(kinds):
        raise ValueError("two mechanisms share a name")
    return named


MECHANISMS = _registry(BoxFold, TentFold, VFold1, VFold2, StepFold)
"""Mechanisms by their name in design.json."""


def mechanism_type(name: str) -> type[Mechanism]:
    """Return the mechanism called `name`.

    Raises
    ------
    DesignError
        There is none of that name.
    """
    try:
        return MECHANISMS[name]
    except KeyError:
        raise DesignError(
            f"there is no mechanism {name!r}; popsim knows {', '.join(sorted(MECHANISMS))}"
        ) from None
