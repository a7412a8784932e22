"""What Inkscape makes of the SVG; skipped where it is not installed."""

import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from printed_design import Printed

from popsim.export import export
from popsim.layout import draw_sheets
from popsim.layout.sheet import Line, Role

INKSCAPE = shutil.which("inkscape")
SPACE = "{http://www.inkscape.org/namespaces/inkscape}"
PIXEL = 25.4 / 96
"""mm; of Inkscape."""

pytestmark = pytest.mark.skipif(INKSCAPE is None, reason="Inkscape is not installed")


def inkscape(*options: str | Path) -> str:
    done = subprocess.run(
        [str(INKSCAPE), *map(str, options)], capture_output=True, text=True, timeout=120, check=True
    )
    return done.stdout


@pytest.fixture(scope="module")
def sheet(printed: Printed, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("inkscape")
    return export(printed.layout, folder / "s.svg", "svg", texture_root=printed.folder)[0]


def layers(path: Path) -> list[str]:
    groups = ElementTree.parse(path).getroot().iter("{http://www.w3.org/2000/svg}g")
    return [group.get(f"{SPACE}label", "") for group in groups if group.get(f"{SPACE}groupmode") == "layer"]


def test_layers_survive(sheet: Path, tmp_path: Path) -> None:
    saved = tmp_path / "saved.svg"
    inkscape(sheet, "--export-type=svg", f"--export-filename={saved}")
    assert {"cut", "mountain", "valley", "print", "label"} <= set(layers(saved))
    assert layers(saved) == layers(sheet)


def test_sizes_are_true(sheet: Path, printed: Printed) -> None:
    """The cut lines of the first sheet, by Inkscape's own measure."""
    lines = [mark.points for mark in draw_sheets(printed.layout)[0].of(Role.CUT) if isinstance(mark, Line)]
    rows = {row.split(",")[0]: row.split(",")[1:] for row in inkscape(sheet, "--query-all").splitlines()}
    _, _, width, height = (float(value) * PIXEL for value in rows["cut"])
    drawn = np.ptp(np.concatenate(lines), axis=0)
    stroke = 0.5
    assert drawn[0] <= width <= drawn[0] + stroke
    assert drawn[1] <= height <= drawn[1] + stroke
