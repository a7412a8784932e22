"""The vocabulary of a design and its file format: patches, hinges, mechanisms, card.

Producers (the mechanisms, a hand, another program) make a :class:`Design`; consumers (verification, layout,
instructions, export) read only that. Everything is immutable and validated; coordinates are those of the open
pose in the card frame of :mod:`popsim.geometry`.
"""

from popsim.design.file import dump_design, load_design, missing_textures, parse_design
from popsim.design.model import (
    BACKDROP_ID,
    GROUND_ID,
    Card,
    Design,
    Hinge,
    HingeKind,
    MechanismRecord,
    Patch,
    Source,
)

__all__ = [
    "BACKDROP_ID",
    "GROUND_ID",
    "Card",
    "Design",
    "Hinge",
    "HingeKind",
    "MechanismRecord",
    "Patch",
    "Source",
    "dump_design",
    "load_design",
    "missing_textures",
    "parse_design",
]
