"""OpenCV on one thread: what uses it works in threads of its own, and a forked process would wait for OpenCV's."""

from functools import lru_cache
from typing import Any


@lru_cache(maxsize=1)
def opencv() -> Any:
    """The module, once its threads are switched off."""
    import cv2

    cv2.setNumThreads(1)
    return cv2
