"""Pictures from the command line."""

from pathlib import Path

from PIL import Image

from popsim.design import Card, dump_design
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold
from popsim.rendering.contact_sheet import CAPTION, GAP

CARD = Card(x=(-60.0, 60.0), depth=80.0)


def test_render_draws_each_angle_from_each_side(popsim, popsim_main, tmp_path: Path) -> None:
    box = BoxFold.plain("M1", card_pair(CARD), 20.0, 25.0, (-30.0, 30.0))
    (tmp_path / "design.json").write_text(dump_design(assemble(CARD, [box])))
    words = ["--angle", 180, "--angle", 90, "--azimuth", 35, "--azimuth", 120, "--width", 64, "--height", 48]
    done = popsim("render", "design.json", "-o", "out.png", *words)
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "out.png") as picture:
        assert picture.size == (2 * (64 + GAP) + GAP, 2 * (48 + 2 * CAPTION + GAP) + GAP)
    again = popsim_main("render", "design.json", "-o", "out.png")
    assert again.returncode == 2 and "--force" in again.stderr
