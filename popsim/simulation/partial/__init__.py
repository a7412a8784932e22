"""Folding what is half made: parts that are joined as far as they are, and led by as few hands as need be.

A partial structure has free motions that the finished pop-up has not, and off the card nothing drives it. So
one hinge is led by hand for each free motion, the card's own fold first, to the angles that it has in the finished
pop-up as that closes. All other hinges are led by nothing: they follow from the loops, or the loops open.

In the end all hands let go and the pile is pressed: where all is flat ways part, and that decides between them.

What counts is measured: how far the loops open, how flat it lies in the end, and how deep plates run through each
other on the way. Folding flat means that such a motion exists.
"""

from popsim.simulation.partial.crossings import Crossings
from popsim.simulation.partial.fold import PartialFold, fold_partial
from popsim.simulation.partial.structure import Structure

__all__ = ["Crossings", "PartialFold", "Structure", "fold_partial"]
