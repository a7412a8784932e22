"""A design with pictures, and what was made of it."""

from pathlib import Path
from typing import NamedTuple

from popsim.assembly import AssemblyPlan
from popsim.design import Design
from popsim.layout import Layout


class Printed(NamedTuple):
    """A design in a folder with its pictures, and what was made of it."""

    design: Design
    folder: Path
    layout: Layout
    plan: AssemblyPlan
