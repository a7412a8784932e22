"""The theory: geometric conditions under which a whole design folds, stands, stays clear and closes.

Sec. 3.3.1 speaks of single mechanisms (each states its own conditions), Sec. 3.3.2 of several on one base patch
pair. Three conditions go beyond the paper: ranges are those of whole *subtrees*, because what stands on a
mechanism may lean over the neighbours of that mechanism; creases that are flat in the open card are stated to the
side to which they fold; and nothing may stick out of the closed card. The conditions are sufficient: they may
refuse a design that works, and must never pass one that does not.
"""

from popsim.validity.faces import faces_clear
from popsim.validity.theory import Theory, examine

__all__ = ["Theory", "examine", "faces_clear"]
