"""The assembly steps as pages to print after the sheets."""

from textwrap import wrap

import numpy as np

from popsim.assembly.plan import AssemblyPlan
from popsim.layout.sheet import TEXT_WIDTH, Mark, Role, Sheet, Text

HEADING = 6.0
"""mm; font size of the heading."""

BODY = 3.4
"""mm; font size of the steps."""

LEADING = 1.45
"""Line pitch in font sizes."""

INDENT = 9.0
"""mm from the number of a step to its text."""


def draw_steps(plan: AssemblyPlan) -> tuple[Sheet, ...]:
    """Pages of the paper's size with the steps; a step is never divided between pages."""
    paper, margin = plan.layout.paper, plan.layout.settings.margin
    letters = int((paper.width - 2 * margin - INDENT) / (TEXT_WIDTH * BODY))
    pages: list[list[Mark]] = []
    y = 0.0
    for step in plan.steps:
        lines = wrap(step.text, letters)
        height = len(lines) * LEADING * BODY
        if not pages or y - height < margin:
            top = paper.height - margin - HEADING
            heading = "Assembly" if not pages else "Assembly, continued"
            pages.append([Text(Role.LABEL, heading, np.array([margin, top]), HEADING, bold=True)])
            y = top - 2 * HEADING
        pages[-1].append(Text(Role.LABEL, f"{step.number}.", np.array([margin, y]), BODY, bold=True))
        for line in lines:
            pages[-1].append(Text(Role.LABEL, line, np.array([margin + INDENT, y]), BODY))
            y -= LEADING * BODY
        y -= 0.6 * BODY
    names = [f"Assembly, page {k} of {len(pages)}" for k in range(1, len(pages) + 1)]
    return tuple(
        Sheet(name, paper.width, paper.height, tuple(marks)) for name, marks in zip(names, pages, strict=True)
    )
