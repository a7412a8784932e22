"""The user's hand: a wishes file says what is kept, forbidden and pinned; every run writes one to edit."""

from popsim.pipeline.wishes.hand import Hand, forbidden_types
from popsim.pipeline.wishes.read import load_wishes, parse_wishes
from popsim.pipeline.wishes.write import wishes_text

__all__ = ["Hand", "forbidden_types", "load_wishes", "parse_wishes", "wishes_text"]
