"""Mirror planes of a sampled surface, also of surfaces that do not stand centred on them."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray, IntArray
from popsim.mesh.sampling import Samples

Partners = tuple[IntArray, FloatArray, FloatArray]

WORKERS = 2
"""Threads that look for neighbours; the answer is the same with any number."""
NEIGHBOURS = 8
"""Samples near a mirrored one that may be its partner."""
REFINEMENTS = 3
"""Gauss-Newton steps of the offset; it moves less than a hundredth of the spacing after them."""
BINS = 128
"""Slabs in which the area is gathered to guess where off-centre planes may lie."""
MIDDLE_MARGIN = 0.06
"""An off-centre plane must score this much higher than the one through the middle of the bounding box."""
SCORE_NOISE = 0.01
"""Scores repeat to about this when the samples change; a shift by a part of the spacing must gain more."""
WORTH_OFF_CENTRE = 0.6
"""Below this score a surface is hardly symmetric, and no plane but the middle one is worth its off-centre fold."""


@dataclass(frozen=True, eq=False)
class MirrorPlane:
    """The plane n . p = offset, and how well the surface is its own mirror image in it.

    Attributes
    ----------
    normal:
        Unit normal n, shape (3,).
    offset:
        In the unit of the surface.
    score:
        Area share that finds a partner: 1 is perfect, scattered triangles reach about 0.4.
    centred:
        Whether it is (nearly) the plane through the middle of the bounding box.
    """

    normal: FloatArray
    offset: float
    score: float
    centred: bool


class MirrorSearch:
    """Scores mirror planes of one set of samples."""

    def __init__(self, samples: Samples) -> None:
        from scipy.spatial import cKDTree  # slow import

        self._samples = samples
        self._tree = cKDTree(samples.points)
        self._weight = samples.area / samples.area.sum()
        self._known: dict[tuple[bytes, float], Partners] = {}

    def score(self, normal: FloatArray, offset: float) -> float:
        """Return the area share, 0..1, that finds a partner across the plane."""
        return float(self._weight @ self._partners(normal, offset)[1])

    def best_plane(self, normal: FloatArray, extent: tuple[float, float], *, quick: bool = False) -> MirrorPlane:
        """Find the best plane with this unit normal.

        Parameters
        ----------
        normal:
            Shape (3,).
        extent:
            Least and greatest n . p of the surface (of what counts of it).
        quick:
            Look near the middle and the centroid only.
        """
        middle = (extent[0] + extent[1]) / 2
        tolerance = self._samples.spacing / 4
        best, best_score = middle, self.score(normal, middle)
        refined = self._refined(normal, middle)
        if abs(refined - middle) <= tolerance and self.score(normal, refined) > best_score + SCORE_NOISE:
            best, best_score = refined, self.score(normal, refined)
        needed = max(best_score + MIDDLE_MARGIN, WORTH_OFF_CENTRE)
        guesses = [
            refined,
            float(self._weight @ self._samples.points @ normal),
        ]  # every perfect plane holds the centroid
        if not quick:
            guesses += self._guesses(normal, extent)
        for guess in guesses:
            if needed >= 1.0 or abs(guess - best) < tolerance:
                continue
            offset = self._refined(normal, guess)
            score = self.score(normal, offset)
            if score > needed:
                best, best_score, needed = offset, score, score
        return MirrorPlane(normal, best, best_score, bool(abs(best - middle) <= tolerance))

    def _partners(self, normal: FloatArray, offset: float) -> Partners:
        """As :meth:`_found`; planes are asked about more than once."""
        key = normal.tobytes(), offset
        if key not in self._known:
            self._known[key] = self._found(normal, offset)
        return self._known[key]

    def _found(self, normal: FloatArray, offset: float) -> Partners:
        """Return of each sample the partner, how well it fits (0..1), and its distance off the partner's face.

        A partner lies within 1.5 spacings, faces the same way up to sign, and its face passes near by.
        """
        points, normals, spacing = self._samples.points, self._samples.normals, self._samples.spacing
        image = points - 2 * (points @ normal - offset)[:, None] * normal
        facing = normals - 2 * (normals @ normal)[:, None] * normal
        count = min(NEIGHBOURS, len(points))
        distance, index = self._tree.query(image, k=count, distance_upper_bound=1.5 * spacing, workers=WORKERS)
        distance, index = distance.reshape(-1, count), index.reshape(-1, count)
        found = np.isfinite(distance)
        index = np.where(found, index, 0)
        gap = np.einsum("ikj,ikj->ik", points[index] - image[:, None], normals[index])
        agreement = np.abs(np.einsum("ij,ikj->ik", facing, normals[index]))
        fit = found * np.exp(-((gap / (0.4 * spacing)) ** 2)) * agreement**2
        best = fit.argmax(axis=1)
        rows = np.arange(len(points))
        return index[rows, best], fit[rows, best], gap[rows, best]

    def _refined(self, normal: FloatArray, offset: float) -> float:
        """Move the plane to where the gaps between partners are least (they shift by 2 n . n_q per unit)."""
        for _ in range(REFINEMENTS):
            partner, fit, gap = self._partners(normal, offset)
            slope = 2 * self._samples.normals[partner] @ normal
            weight = self._weight * fit
            stiffness = float(weight @ slope**2)
            if stiffness < 1e-6:
                break
            offset += float(weight @ (slope * gap)) / stiffness
        return offset

    def _guesses(self, normal: FloatArray, extent: tuple[float, float]) -> list[float]:
        """Offsets about which the area per slab is most like its own mirror image."""
        position = self._samples.points @ normal
        slabs, _ = np.histogram(position, BINS, range=extent, weights=self._weight)
        likeness = np.convolve(slabs, slabs)  # entry i + j belongs to the mid-plane of slabs i and j
        inner = likeness[1:-1]
        peaks = np.flatnonzero((inner >= likeness[:-2]) & (inner > likeness[2:])) + 1
        best = peaks[np.argsort(-likeness[peaks], kind="stable")][:2]
        width = (extent[1] - extent[0]) / BINS
        return [float(extent[0] + (k + 1) * width / 2) for k in best]
