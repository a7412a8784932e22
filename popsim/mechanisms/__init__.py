"""The pop-up mechanisms: each file holds one, and the registry names them all.

A mechanism stands on a base patch pair and is made of plates (its patches) and joints (its hinges) in the open
pose. It knows in closed form where its plates are at every fold angle, which pairs it offers to others, which
primitives it can represent (Table 1) and what must hold for it to fold and to stand (Sec. 3.3.1). Nothing
outside a mechanism's own file asks which mechanism it is: a new one is a new file and one entry here.
"""

from popsim.mechanisms.assemble import Shape, assemble
from popsim.mechanisms.base import Mechanism, Recognition
from popsim.mechanisms.company import AS_THEY_ARE, Depths, plates_of, plates_together
from popsim.mechanisms.condition import Condition
from popsim.mechanisms.fault import Fault
from popsim.mechanisms.members import Members
from popsim.mechanisms.pair import BasePatchPair, PairKind, card_pair
from popsim.mechanisms.plate import Joint, Plate
from popsim.mechanisms.primitive import Primitive, PrismRow, RectangularPrism, TriangularPrism
from popsim.mechanisms.registry import MECHANISMS, mechanism_type
from popsim.mechanisms.room import Room

__all__ = [
    "AS_THEY_ARE",
    "MECHANISMS",
    "BasePatchPair",
    "Condition",
    "Depths",
    "Fault",
    "Joint",
    "Mechanism",
    "Members",
    "PairKind",
    "Plate",
    "Primitive",
    "PrismRow",
    "Recognition",
    "RectangularPrism",
    "Room",
    "Shape",
    "TriangularPrism",
    "assemble",
    "card_pair",
    "mechanism_type",
    "plates_of",
    "plates_together",
]
