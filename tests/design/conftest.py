"""A small nested design as the plain data that a hand would write."""

import json
from typing import Any

import pytest

from popsim.design import Card, Design, Source, dump_design
from popsim.mechanisms import PairKind, Shape, assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.mechanisms.v_fold_2 import VFold2


@pytest.fixture(scope="session")
def design() -> Design:
    card = Card(x=(-105.0, 105.0), depth=148.0)
    box = BoxFold.plain("M1", card_pair(card), 30.0, 40.0, (-20.0, 20.0))
    top = next(pair for pair in box.pairs() if pair.kind is PairKind.OPENING)
    corner = next(pair for pair in box.pairs() if pair.kind is PairKind.CORNER)
    parts = [
        box,
        TentFold("M2", top, (-10.0, 10.0), 12.0, 9.0),
        StepFold("M3", corner, (-5.0, 15.0), 10.0, 20.0),
        VFold2("M4", card_pair(card), 80.0, 12.0, 25.0),
    ]
    identity = tuple(tuple(float(i == j) for j in range(4)) for i in range(4))
    side = next(plate for plate in box.plates() if plate.role == "L").outline
    window = Shape(side, (side * [0.5, 1.0, 0.5] + [0.0, 0.0, 10.0],), texture="textures/M1.L.png")
    source = Source(file="house.obj", sha256="0" * 64)
    return assemble(card, parts, {"M1.L": window}, source=source, model_to_card=identity)


@pytest.fixture
def data(design: Design) -> dict[str, Any]:
    """A fresh copy that a test may spoil."""
    return json.loads(dump_design(design))
