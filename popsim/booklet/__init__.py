"""The booklet: how to build a pop-up in pictures that a ten-year-old can follow.

:mod:`popsim.booklet.sight` finds what is seen of flat paper in space, :mod:`popsim.booklet.figure` draws the
states before and after a step, :mod:`popsim.booklet.pages` and :mod:`popsim.booklet.html` put them together. All
drawings are marks of :mod:`popsim.layout.sheet` with the roles of :mod:`popsim.booklet.inks`, so the writers of
sheets write them; all words stand in :mod:`popsim.wording`.
"""

from popsim.booklet.booklet import begun_booklet
from popsim.booklet.format import booklet_format
from popsim.booklet.write import begun_picture, write_booklet

__all__ = ["begun_booklet", "begun_picture", "booklet_format", "write_booklet"]
