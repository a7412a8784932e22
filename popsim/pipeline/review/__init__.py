"""What a user should know of a design beyond its verdict: doubts, what is not shown, what is held up."""

from popsim.pipeline.review.bare import bare_sides
from popsim.pipeline.review.doubts import doubts
from popsim.pipeline.review.leftovers import leftovers
from popsim.pipeline.review.overhang import overhang

__all__ = ["bare_sides", "doubts", "leftovers", "overhang"]
