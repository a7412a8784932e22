"""Sheets and steps planned together, with the flaps folded along."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from popsim.assembly import AssemblyPlan, plan_assembly
from popsim.beside import begun
from popsim.design import Design
from popsim.export import Printing, export
from popsim.gluing import FlapContact, find_flap_contacts, keeping_clear
from popsim.layout import Layout, LayoutSettings, lay_out
from popsim.simulation import Sweep, fold_design

ANGLES = 90
"""Recorded fold angles each way where a design is folded for its flaps alone."""


@dataclass(frozen=True, eq=False)
class Planned:
    """A layout with its assembly.

    Attributes
    ----------
    plan:
        Steps, and the layout numbered in their order.
    contacts:
        Flaps that touch what they should not though all else was tried; None where the design does not fold, so
        that nothing can be said.
    """

    plan: AssemblyPlan
    contacts: tuple[FlapContact, ...] | None

    @property
    def layout(self) -> Layout:
        """The layout, numbered in the order of the steps."""
        return self.plan.layout

    @property
    def unproved(self) -> tuple[str, ...]:
        """Joints for which no way was found."""
        return tuple(
            f"no way was found to glue {', '.join(str(self.layout.numbers[name]) for name in step.joints)}: "
            f"{step.evidence.way}"
            for step in self.plan.unproved
            if step.evidence is not None
        )

    @property
    def notes(self) -> tuple[str, ...]:
        """What is not as it should be, one sentence each."""
        if self.contacts is None:
            return (*self.unproved, "flaps were not folded with the design, because its motion breaks off")
        return self.unproved + tuple(
            f"flap {self.layout.numbers[one.flap.joint.id]} is in the way of {one.other} by {one.bite:.1f} mm at "
            f"{np.degrees(one.theta):.0f} degrees: trim it there"
            for one in self.contacts
        )


def plan_sheets(design: Design, sweep: Sweep, *, paper: str, settings: LayoutSettings) -> Planned:
    """Lay a design out so that no flap is in the way of its motion `sweep`, and plan its assembly.

    Raises
    ------
    LayoutError
        The paper is unknown, or the design does not go onto it.
    """
    if not sweep.complete:
        return Planned(plan_assembly(lay_out(design, paper=paper, settings=settings), sweep), None)
    clear = keeping_clear(sweep, settings.thickness)
    layout = lay_out(design, paper=paper, settings=settings, in_the_way=clear)
    contacts = begun(lambda own: find_flap_contacts(own.parts, own.flaps, sweep, settings.thickness), [layout])
    plan = plan_assembly(layout, sweep)
    return Planned(plan, contacts()[0])


def export_sheets(
    design: Design,
    path: Path,
    format: str,
    *,
    textures: Path,
    paper: str,
    settings: LayoutSettings,
    printing: Printing,
    force: bool,
) -> tuple[Path, ...]:
    """Write the sheets of any design in one format; parameters and errors as :func:`popsim.export.export`."""
    sweep = fold_design(design, ANGLES).sweep
    planned = plan_sheets(design, sweep, paper=paper, settings=settings)
    return export(
        planned.layout,
        path,
        format,
        texture_root=textures,
        printing=replace(printing, notes=(*printing.notes, *planned.notes)),
        plan=planned.plan,
        sweep=sweep,
        force=force,
    )
