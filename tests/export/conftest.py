"""A design with pictures, laid out and planned."""

import numpy as np
import pytest
from PIL import Image
from printed_design import Printed

from popsim.assembly import plan_assembly
from popsim.design import Card, Design
from popsim.layout import lay_out
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold, Top
from popsim.mechanisms.pair import PairKind
from popsim.mechanisms.tent_fold import TentFold
from popsim.mechanisms.v_fold_1 import VFold1
from popsim.simulation import fold_design


@pytest.fixture(scope="session")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Printed:
    """A stepped box with a tent on it beside a v-fold; every patch has a picture but the card."""
    folder = tmp_path_factory.mktemp("printed")
    (folder / "textures").mkdir()
    card = Card(x=(-80, 80), depth=110)
    box = BoxFold.stepped("M1", card_pair(card), 20, (Top(-40, 0, 20), Top(0, 40, 35)))
    top = next(pair for pair in box.pairs() if pair.kind is PairKind.OPENING)
    tent = TentFold("M2", top, (-35, -10), 12, 15)
    plain = assemble(card, [box, tent, VFold1("M3", card_pair(card), -50, 15, 25, -1)])
    data = plain.model_dump()
    for index, (patch, made) in enumerate(zip(data["patches"], plain.patches, strict=True)):
        if patch["id"] in ("G", "B"):
            continue
        flat = made.plane.flat(made.points)
        low, high = flat.min(axis=0), flat.max(axis=0)
        corner, right, up = made.plane.lift(np.array([low, [high[0], low[1]], [low[0], high[1]]]))
        pixels = np.full((40, 60, 3), (40 + index * 7, 120, 200 - index * 5), dtype=np.uint8)
        pixels[:8, :8] = (255, 0, 0)  # upper left corner
        Image.fromarray(pixels).save(folder / "textures" / f"{patch['id']}.png")
        patch["texture"] = f"textures/{patch['id']}.png"
        frame = {"origin": corner, "right": right - corner, "up": up - corner}
        patch["texture_frame"] = {name: tuple(map(float, vector)) for name, vector in frame.items()}
    design = Design.model_validate(data)
    layout = lay_out(design)
    return Printed(design, folder, layout, plan_assembly(layout, fold_design(design, 45).sweep))
