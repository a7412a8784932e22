"""Cutting and painting the patches of a fit, and cutting back what verification found in the way."""

from dataclasses import replace
from pathlib import Path

from popsim.design import Design, Source
from popsim.fitting import Fit
from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import assemble
from popsim.patches import Painted, PatchSettings
from popsim.patches.base_page import base_prints
from popsim.patches.cut import Cut, cut
from popsim.patches.paint import paint_cut, with_base
from popsim.pipeline.page import Page, fitting_card
from popsim.pipeline.prepare import Prepared
from popsim.pipeline.territory import territories
from popsim.verification import Verdict, verify

REPAIRS = 5
"""How often contours are cut back, the last time all of them."""

Held = frozenset[str]
"""Ids of patches that are kept within their faces."""


class Painter:
    """Makes designs of one fit."""

    def __init__(
        self, prepared: Prepared, fit: Fit, settings: PatchSettings, path: Path, page: Page | None = None
    ) -> None:
        self.prepared, self.fit, self.settings, self.path, self.page = prepared, fit, settings, path, page
        self.scene = prepared.scene
        self.territories = territories(fit.mechanisms, prepared.bounds)
        self._cuts: dict[Held, Cut] = {}
        self.everything: Held = frozenset(m.patch_id(p.role) for m in fit.mechanisms for p in m.plates())

    def make(self, held: Held, *, prints: bool) -> tuple[Painted, Design]:
        """Patches and design with the patches in `held` kept within their faces, with or without prints."""
        chosen = replace(self.settings, within_face=held)
        if held not in self._cuts:
            self._cuts[held] = cut(self.fit.mechanisms, self.scene, self.territories, chosen, self.fit.depths)
        painted = paint_cut(self._cuts[held], self.scene, chosen, prints=prints)
        outlines: dict[str, FloatArray] = {name: shape.outline for name, shape in painted.shapes.items()}
        card = fitting_card(self.fit.mechanisms, outlines, self.page).model_copy(
            update={"reverse": chosen.reverse}
        )
        if prints:
            painted = with_base(painted, base_prints(self.scene, card, self.fit.mechanisms, chosen), card)
        a, b, c, d = (tuple(float(value) for value in row) for row in self.prepared.to_card)
        design = assemble(
            card,
            self.fit.mechanisms,
            painted.shapes,
            source=Source(file=self.path.name, sha256=self.prepared.model.sha256),
            model_to_card=(a, b, c, d),
        )
        return painted, design

    def verified(self, design: Design) -> tuple[Held, Verdict]:
        """The patches that must be held for a design of this fit to pass, and the last verdict."""
        held: Held = frozenset()
        verdict = verify(design)
        for attempt in range(REPAIRS):
            last = attempt == REPAIRS - 1
            more = self.everything if last else held | self._in_the_way(verdict, held)
            if verdict.passed or more == held:
                break
            held = more
            verdict = verify(self.make(held, prints=False)[1])
        return held, verdict

    def _in_the_way(self, verdict: Verdict, held: Held) -> Held:
        """Of each two patches in collision, that with less beyond its face; all patches if none are named."""
        overhang = self._cuts[held].overhang
        found = set()
        for contact in verdict.evidence.contacts:
            own = [name for name in contact.patches if name in self.everything - held]
            reaching = [name for name in own if overhang[name] > 0] or own
            found |= {min(reaching, key=lambda name: overhang[name])} if reaching else set()
        return frozenset(found) or self.everything
