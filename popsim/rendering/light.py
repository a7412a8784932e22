"""Soft light that shows the shape of a surface: a key light over the viewer's left shoulder and a dome.

The viewer carries the light, so that no view is dark, and a face towards the eye keeps its colour.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from popsim.geometry.arrays import FloatArray

Image = npt.NDArray[np.float32]

DOME, GROUND = 0.64, 0.56  # brightness of the dome above and of what the ground gives back
KEY = 0.55  # brightness added by the key light
KEY_RIGHT, KEY_UP, KEY_EYE = -0.45, 0.75, 0.8  # where it stands, in the axes of the view
GROUND_TINT = np.array([1.0, 0.985, 0.96], dtype=np.float32)  # what comes from below is a little warmer
LINE = 0.32  # brightness left under a feature line


@dataclass(frozen=True, eq=False)
class Light:
    """The light of a view: `key` points to the key light, `zenith` to the top of the dome; both (3,)."""

    key: FloatArray
    zenith: FloatArray

    @classmethod
    def of_view(cls, right: FloatArray, up: FloatArray, eye: FloatArray, zenith: FloatArray) -> "Light":
        """Return the light carried by a viewer with these unit axes, shape (3,) each."""
        key = KEY_RIGHT * right + KEY_UP * up + KEY_EYE * eye
        return cls(key / np.linalg.norm(key), np.asarray(zenith, dtype=np.float64))

    def shade(self, normals: Image, key_seen: Image | float = 1.0, dome_seen: Image | float = 1.0) -> Image:
        """Return the factor by which light changes colours, shape (..., 3).

        Parameters
        ----------
        normals:
            Unit normals that point to the viewer, shape (..., 3).
        key_seen, dome_seen:
            Which parts of the key light and of the dome are not hidden, shape (...), 0..1.
        """
        key = KEY * np.clip(normals @ self.key.astype(np.float32), 0, None) * key_seen
        above = 0.5 + 0.5 * (normals @ self.zenith.astype(np.float32))
        dome = DOME * above * dome_seen
        ground = GROUND * (1 - above) * dome_seen
        result: Image = (key + dome)[..., None] + ground[..., None] * GROUND_TINT
        return result


def facing(normals: Image, directions: FloatArray | Image) -> Image:
    """Return `normals` (..., 3) turned against the view `directions` (broadcast to the same shape)."""
    away = np.einsum("...d,...d->...", normals, np.broadcast_to(directions, normals.shape)) > 0
    return np.where(away[..., None], -normals, normals)
