"""From a model file to a verified design and its sheets, in seven stages.

Load and align, measure, fit and map, size the card, paint the patches, verify, export. Each stage says in the
report what it did and what it left out; nothing is exported that did not fold.
"""

from popsim.pipeline.prepare import Stance
from popsim.pipeline.run import DesignRun, run_design
from popsim.pipeline.settings import RunSettings

__all__ = ["DesignRun", "RunSettings", "Stance", "run_design"]
