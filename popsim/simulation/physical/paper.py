"""Folding a design as the paper it is made of."""

from dataclasses import dataclass

import numpy as np

from popsim.geometry.arrays import FloatArray
from popsim.simulation.physical.clearance import Clearance, clearance
from popsim.simulation.physical.loads import Loads
from popsim.simulation.physical.sag import Sag, sags
from popsim.simulation.physical.stack import Stack, closed_stack
from popsim.simulation.physical.statics import Balance, balance
from popsim.simulation.rig import Rig
from popsim.simulation.sweep import Sweep
from popsim.stock import Stock

MEASURED_DEGREES = (179, *range(178, 0, -2), 1)
"""Fold angles at which forces and gaps are measured: at 180 and 0 flat creases have no lever, forces no end."""

COMPARED_DEGREES = (10.0, 170.0)
"""Where torque is compared with the slope of the energy, which nearer to open and closed is too curved to be taken
from recorded angles."""


@dataclass(frozen=True, eq=False)
class Torque:
    """What turns the backdrop about the central fold, from open to closed.

    Attributes
    ----------
    theta:
        Fold angles, rad, shape (n,).
    torque:
        What a hand must turn with to hold the card there, N mm, positive towards closing, shape (n,).
    by_energy:
        The same as the slope of the energy of heights and creases (virtual work), N mm, shape (n,).
    unbalanced:
        Greatest moment at any joint that nothing holds, N mm, shape (n,).
    """

    theta: FloatArray
    torque: FloatArray
    by_energy: FloatArray
    unbalanced: FloatArray

    @property
    def disagreement(self) -> float:
        """Greatest difference between measured torque and slope of the energy within COMPARED_DEGREES, N mm."""
        low, high = np.radians(COMPARED_DEGREES)
        inside = (self.theta >= low) & (self.theta <= high)
        return float(np.abs(self.torque - self.by_energy)[inside].max(initial=0.0))

    @property
    def rests(self) -> tuple[float, ...]:
        """Fold angles to which the card goes by itself, rad: held open above them and closed below."""
        ahead, behind = self.torque[:-1], self.torque[1:]
        rows = np.flatnonzero((ahead < 0) & (behind >= 0))
        shares = ahead[rows] / (ahead[rows] - behind[rows])
        return tuple((self.theta[rows] + shares * (self.theta[rows + 1] - self.theta[rows])).tolist())


@dataclass(frozen=True, eq=False)
class PaperRun:
    """What a design does as real paper: see the package for the models.

    Attributes
    ----------
    stock:
        The paper.
    weight:
        Of the pop-up with its pages, N.
    torque, clearance:
        While closing.
    stack:
        Of the closed card.
    sags:
        Of the open card, the greatest first.
    """

    stock: Stock
    weight: float
    torque: Torque
    stack: Stack
    sags: tuple[Sag, ...]
    clearance: Clearance


def fold_paper(rig: Rig, sweep: Sweep, stock: Stock) -> PaperRun:
    """Measure torque, stack, sag and clearance of what `rig` has folded.

    The loops must have closed, and nothing may move freely: else poses mean nothing to begin with.
    """
    loads = Loads(sweep.design, stock)
    frames = sweep.closing_at(MEASURED_DEGREES)
    poses, theta = sweep.poses[frames], sweep.theta[frames]
    with rig.without_preloads():
        balances = [balance(rig, sweep, *each) for each in zip(frames, loads.wrenches(poses, theta), strict=True)]
        hanging = balance(rig, sweep, frames[0], loads.of_weight(poses[:1], theta[:1])[0])
    return PaperRun(
        stock=stock,
        weight=float(loads.weights.sum()),
        torque=_torque(sweep, loads, frames, balances),
        stack=closed_stack(sweep, stock.thickness),
        sags=sags(sweep.design, poses[0], theta[0], loads, hanging, stock),
        clearance=clearance(sweep, frames, stock.thickness),
    )


def _torque(sweep: Sweep, loads: Loads, frames: list[int], balances: list[Balance]) -> Torque:
    around = np.array(frames)[:, None] + [-1, 1]
    theta = sweep.theta[around]
    energy = loads.energy(sweep.poses[around.ravel()], theta.ravel()).reshape(-1, 2)
    return Torque(
        theta=sweep.theta[frames],
        torque=np.array([balance.torque for balance in balances]),
        by_energy=-(energy[:, 1] - energy[:, 0]) / (theta[:, 1] - theta[:, 0]),
        unbalanced=np.array([balance.unbalanced for balance in balances]),
    )
