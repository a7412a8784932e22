"""From the plain faces of mechanisms to patches with contours and prints of the model (Sec. 4.3)."""

from popsim.patches.paint import Painted, paint
from popsim.patches.settings import PatchSettings

__all__ = ["Painted", "PatchSettings", "paint"]
