"""Sheets as files: PDF to print, SVG to edit and cut, and whatever else the table of formats names."""

from popsim.export.formats import FORMATS
from popsim.export.printing import Printing
from popsim.export.sheets import export
from popsim.export.styles import STYLES

__all__ = ["FORMATS", "STYLES", "Printing", "export"]
