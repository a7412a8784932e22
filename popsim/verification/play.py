"""How much give a design needs from its paper, at which hinge, and how to need less.

Rigid plates fold with a loop gap of nothing, or not at all; paper gives way by some tenths of a millimetre. So a
gap beyond `Settings.rigid` and up to `Settings.play` is graded *within play* and counts as foldable. That is
right of paper and says less of the geometry:

- Lengths that do not quite add up count as foldable too. A box-fold whose backbone is too long or too short misses
  b + r = c + t_b (Sec. 3.3.1) and cannot fold rigidly; it needs as much play as it misses by, at the closed card,
  to 2 % up to 0.15 mm and to a seventh up to 0.3 mm (half widths 15 to 60 mm, heights 20 to 80 mm).
- Slanted sides never fold rigidly, although the condition of the paper holds to the last digit (Sec. 4.2, the
  ship). b + r = c + t_b is exact for the cross-section, and for the whole box only if its sides are parallel to
  the backbone: while it closes, a front pair that is hinged along the whole of two slanted edges is twisted.

How many mm that is depends on who gives way. For sides that lean 1, 2, 4 or 8 mm over a height of 40 mm (half
width 30 mm), at the worst angle:

===============================================  =====================  ======================
gap in mm                                        leaning inward         leaning outward
===============================================  =====================  ======================
if the ridge of the pair alone opens             0.31, 0.64, 1.39, 3.3  0.29, 0.56, 1.05, 1.87
as reported here                                 0.19, 0.40, 0.89, 2.2  0.18, 0.34, 0.63, 1.08
if all hinges of the box share it evenly         0.05, 0.11, 0.24, 0.57  0.05, 0.09, 0.17, 0.29
===============================================  =====================  ======================

The first row is a closed form, the last a least-squares fit with every hinge free to open. What is reported lies
between: the hinges that close loops open, those of the spanning forest do not, and the solver finds the
compromise among the former. Joining a slanted edge along a part of its length only needs less, because what twists
is shorter: that is measured by folding the design again, with the rest of the edge free.

So the condition is sharp where sides are parallel. Of designs that miss it three things are told on the safe side:

- Almost closed, a backbone that is too long by d does not open a hinge by d but buckles by the root of d: 0.05 mm
  move the tops of a box that is wider than high by 1 mm, through a page that would hold them back if plates pushed
  each other here. Such a design is refused as not clear at 1 to 9 degrees.
- The loops of such boxes tear near the closed card when they miss by 0.2 mm, before the play of 0.3 mm is used up.
- Of boxes four times as high as half as wide that miss by 0.05 mm or less, up to 0.08 mm is reported: a sweep
  damped for loops that cannot close does not quite settle a few degrees from the open card.
"""

from dataclasses import dataclass

import numpy as np

from popsim.design import Design, Hinge
from popsim.simulation.folding import fold_design
from popsim.verification.evidence import Evidence
from popsim.verification.settings import Settings

LEANS = 1e-3
"""Rise over length, and as much short of upright, from which an edge slants."""

KEPT = 0.25
"""Of a slanted edge, from its lower end, that stays joined."""

HELPS = 0.9
"""A remedy leaves at most this much of the gap."""

HOPELESS = 10.0
"""Of the play that paper has; beyond, no remedy is looked for."""


@dataclass(frozen=True)
class Play:
    """What the loops of a design need.

    Attributes
    ----------
    needed:
        Largest loop gap, mm.
    hinge, patches, theta:
        Where: id of the hinge that opens most, its patches, and the fold angle, rad.
    slanted:
        Ids of the hinges on slanted edges.
    shortened:
        Largest loop gap with these joined along the lower KEPT of their length only, mm; None where no edge slants
        or it does not help.
    """

    needed: float
    hinge: str
    patches: tuple[str, str]
    theta: float
    slanted: tuple[str, ...]
    shortened: float | None

    @property
    def sentence(self) -> str:
        """All of it in words."""
        where = f"{' and '.join(self.patches)} at {np.degrees(self.theta):.4g} deg"
        need = f"needs {self.needed:.2g} mm of play at hinge {self.hinge} ({where})"
        if self.shortened is not None:
            joined = (
                f"with hinges {', '.join(self.slanted)} joined along the lowest {KEPT:.0%} of their length only"
            )
            return f"{need}; edges slant: {joined} it needs {self.shortened:.2g} mm"
        return f"{need}: lengths around it do not add up, which paper gives way to and rigid plates do not"


def play_needed(design: Design, evidence: Evidence, settings: Settings) -> Play | None:
    """The play that a folded design needs, or None where it folds rigidly, or nothing tells."""
    worst, needed = evidence.gaps.worst, evidence.gaps.largest
    if worst is None or not evidence.sweep.complete or needed <= settings.rigid:
        return None
    slanted = [hinge for hinge in design.hinges if _slants(hinge)] if needed <= HOPELESS * settings.play else []
    shortened = _gap_if_shortened(design, slanted, settings) if slanted else np.inf
    return Play(
        needed=needed,
        hinge=worst[0].id,
        patches=worst[0].patches,
        theta=worst[1],
        slanted=tuple(hinge.id for hinge in slanted),
        shortened=shortened if shortened <= HELPS * needed else None,
    )


def _slants(hinge: Hinge) -> bool:
    """Whether an axis is neither level nor upright in the open pose."""
    rise = abs(float(hinge.points[1, 2] - hinge.points[0, 2])) / hinge.length
    return LEANS < rise < float(np.sqrt(1 - LEANS**2))


def _gap_if_shortened(design: Design, slanted: list[Hinge], settings: Settings) -> float:
    """Largest loop gap of the design with hinges joined along their lower KEPT only, mm."""
    short = {hinge.id: _shortened(hinge) for hinge in slanted}
    hinges = tuple(short.get(hinge.id, hinge) for hinge in design.hinges)
    folding = fold_design(Design(**{**dict(design), "hinges": hinges}), settings.angles)
    return folding.gaps.largest if folding.sweep.complete else np.inf


def _shortened(hinge: Hinge) -> Hinge:
    low, high = sorted(hinge.points.tolist(), key=lambda point: point[2])
    end = (np.array(low) + KEPT * (np.array(high) - low)).tolist()
    return Hinge(**{**dict(hinge), "axis": (tuple(low), tuple(end))})
