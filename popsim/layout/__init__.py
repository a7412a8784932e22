"""Sheets of paper from a design: pieces, flaps, places on sheets, marks (Sec. 4.4).

Only patches, hinges and textures of a design are read. A *part* is a rigid bit of paper (a patch, or a part of
one too large for the sheet); parts unfolded together across folds are a *net*; a net with its flaps is a *piece*,
which is cut out in one go. :func:`lay_out` makes all of it, :func:`draw_sheets` records it as marks with roles.
"""

from popsim.layout.drawing import draw_sheets
from popsim.layout.errors import LayoutError, NoFlapError
from popsim.layout.flap import Flap
from popsim.layout.folding import Crease
from popsim.layout.joints import Joint
from popsim.layout.keep_off import KeepOff
from popsim.layout.layout import Layout, Placement, lay_out
from popsim.layout.paper import PAPERS, Paper, find_paper
from popsim.layout.parts import Part
from popsim.layout.pieces import Fold, Piece
from popsim.layout.settings import LayoutSettings
from popsim.layout.sites import Face

__all__ = [
    "PAPERS",
    "Crease",
    "Face",
    "Flap",
    "Fold",
    "Joint",
    "KeepOff",
    "Layout",
    "LayoutError",
    "LayoutSettings",
    "NoFlapError",
    "Paper",
    "Part",
    "Piece",
    "Placement",
    "draw_sheets",
    "find_paper",
    "lay_out",
]
