"""Whether mechanisms with plain faces keep clear of each other: what fitting asks a hundred times."""

from collections.abc import Sequence

from popsim.mechanisms import Mechanism
from popsim.validity.clear import clear_conditions
from popsim.validity.reach import FaceReach


def faces_clear(mechanisms: Sequence[Mechanism]) -> bool:
    """Whether mechanisms with plain faces keep clear of each other while closing (Sec. 3.3.2, for whole subtrees).

    Parameters
    ----------
    mechanisms:
        Each stands on the card or on an earlier one, and is valid by itself.
    """
    by_id = {mechanism.id: mechanism for mechanism in mechanisms}
    return all(condition.holds for condition in clear_conditions(by_id, FaceReach(by_id)))
