"""A small pop-up, how it is put together, and the folder with its booklet."""

from pathlib import Path
from typing import NamedTuple

from popsim.assembly import AssemblyPlan
from popsim.design import Design


class Built(NamedTuple):
    """A design, its plan and the folder with its booklet."""

    design: Design
    plan: AssemblyPlan
    folder: Path
