"""What real paper adds to the rigid plates: weight, springs at the creases, thickness.

A second run, in the poses that the sweep has recorded. It changes nothing of the verdict: rigid plates have one
motion, which no weight or spring can alter; what these decide is which force the motion takes.

**The table.** The ground lies on a table, and gravity pulls at right angles to it; the backdrop is the page that
is turned, from lying open (180 degrees) over upright (90) to lying on the pop-up (0).

**Creases** (:mod:`.creases`). Every hinge, the central fold too, is a linear spring along its whole length that
rests at a right angle: a fold that was pressed flat and let go springs back to about half open, and gluing a wall
upright is its rest too. Stiffness per length is that of the stock.

**Torque** (:mod:`.statics`). Held at an angle, with weights and crease moments on all plates, the pop-up comes to
rest in MuJoCo within the stretch of its loops. The constraint forces of the loops are measured there and carried
through the joints to the backdrop; what is out of balance on it is the torque of the hand. Nothing moves while it
is measured, so there is no inertia in it. The slope of the energy of heights and creases says the same without any
forces (virtual work) and is reported beside it. Friction and hysteresis of real creases are not modelled: the
torque is the mean of closing and opening.

**Sag** (:mod:`.sag`), **stack** (:mod:`.stack`) and **clearance** (:mod:`.clearance`) state their models there.
"""

from popsim.simulation.physical.paper import PaperRun, fold_paper

__all__ = ["PaperRun", "fold_paper"]
