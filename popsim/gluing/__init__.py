"""Flaps in the folding: plates that move with what they are glued to, and must touch nothing else.

Layout knows nothing of motion, and simulation nothing of flaps; here both are known.
"""

from popsim.gluing.contacts import FlapContact, find_flap_contacts, keeping_clear

__all__ = ["FlapContact", "find_flap_contacts", "keeping_clear"]
