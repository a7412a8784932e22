"""Folding a design in MuJoCo as hinged rigid plates, and measuring what happens.

**Model.** One body per patch, in the frame of the open pose, so that the pose of a body *is* the motion of its
patch. A spanning forest rooted at ground and backdrop carries one hinge joint per tree hinge; every other hinge
closes a loop by two `connect` equalities, one at each end of its axis. Ground and backdrop are mocap bodies: the
mechanisms fall apart into independent islands and the cost grows linearly. Lengths are divided by the size of the
pop-up, so that a 50 mm and a 500 mm card are the same model.

**Verdict.** A soft constraint can stretch, so nothing here trusts the solver: loop gaps, flatness and ranges are
measured from the recorded poses with the real outlines, in millimetres. No solver setting can make a gap small
in poses where hinges do not meet.

**Settling.** At each recorded angle the pages are held for a few steps with velocities set to zero. That makes
each step a Gauss-Newton step on the loop equations; it converges where they can be met, and stays where not. The
rest is polished off the joint angles (:mod:`popsim.simulation.polish`).

**Paper in the way.** Joints stop where two patches lie face to face, and flat creases go to the side that the
design says: paper does not turn through itself. That also keeps a closed card from opening crosswise.

**Crossings.** Four ways to pass through each other are looked for: a patch that reaches through another at a
recorded angle, a fold inside a third patch, a patch that is on the other side of another one angle later (parallel
plates meet all at once), and patches that turn past each other about one line, hinged to each other or not.

MuJoCo is imported inside functions, and only in this package.
"""

from popsim.simulation.folding import Folding, fold_design
from popsim.simulation.gaps import Gaps
from popsim.simulation.sweep import Sweep
from popsim.simulation.viewer import to_mjcf

__all__ = ["Folding", "Gaps", "Sweep", "fold_design", "to_mjcf"]
