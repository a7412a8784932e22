"""The pop-up in space: GLB with the folding as an animation, OBJ and STL of one fold angle.

The sheets are what is cut; this is what they become. Units and axes are those of each format: glTF is in metres
and y up, OBJ and STL have neither and keep millimetres and the card frame.
"""

from popsim.export.solid.export import SOLIDS, export_solid

__all__ = ["SOLIDS", "export_solid"]
