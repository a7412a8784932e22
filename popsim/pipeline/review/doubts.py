"""When a design should not be trusted to be what its user had in mind."""

from popsim.fitting.appearance import Likeness
from popsim.geometry.surface import Surface
from popsim.mesh.alignment import Alignment
from popsim.mesh.connection import loose_share

LOOSE = 0.3
"""Share of the area in triangles that hang together with nothing, from which on a model is a heap."""
UNSURE = 0.5
"""Confidence below which another side is as likely up."""
UNLIKE = 0.5
"""Likeness (mean of silhouette and relief, before contours are cut) below which a pop-up hardly resembles its
model."""


def doubts(surface: Surface, alignment: Alignment, likeness: Likeness) -> tuple[str, ...]:
    """Return the reasons for low confidence, one sentence each; none where there are none."""
    found = []
    if (share := loose_share(surface)) > LOOSE:
        found.append(f"the model is a heap of loose triangles ({share:.0%} of its area), not a thing with sides")
    if alignment.up.confidence < UNSURE:
        found.append(f"which way is up is a guess (confidence {alignment.up.confidence:.2f}); say it with --up")
    if likeness.overall < UNLIKE:
        found.append(
            f"the pop-up resembles the model little (silhouette {likeness.silhouette:.2f}, relief "
            f"{likeness.relief:.2f} of 1)"
        )
    return tuple(f"low confidence: {reason}" for reason in found)
