"""Pictures of a result: the open or half closed pop-up, beside its model and its sheets."""

from popsim.pictures.look import Look
from popsim.pictures.strip import beside, open_picture, open_shot, picture_strip

__all__ = ["Look", "beside", "open_picture", "open_shot", "picture_strip"]
