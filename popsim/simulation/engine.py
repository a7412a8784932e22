"""MuJoCo, loaded without its windows."""

import os
from typing import Any

WINDOWS = "MUJOCO_GL"
"""Environment variable that says which window library MuJoCo loads at import: that takes longer than to fold a
small design, and nothing here opens windows."""


def load_mujoco() -> Any:
    """The module; the environment is left as it was."""
    chosen = os.environ.get(WINDOWS)
    os.environ.setdefault(WINDOWS, "disable")
    try:
        import mujoco
    finally:
        if chosen is None:
            del os.environ[WINDOWS]
    mujoco.set_mju_user_warning(_ignore)
    return mujoco


def _ignore(message: str) -> None:
    """MuJoCo's warnings go unheard: what they mean for the verdict is measured, not printed or logged."""
