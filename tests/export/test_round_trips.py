"""What is written is read back with other libraries, cut out, and compared with the design."""

from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from printed_design import Printed
from rebuild import TRUE, Lines, bends_away, faces, match
from svgelements import SVG, Group
from svgelements import Path as SvgPath

from popsim.design import Design
from popsim.export import export

LAYERS = ("cut", "mountain", "valley")


def read_svg(path: Path) -> Lines:
    """Lines by layer, with svgelements at 25.4 units per inch: one unit is a millimetre."""
    svg = SVG.parse(str(path), ppi=25.4)
    layers: dict[str, list[np.ndarray]] = {name: [] for name in LAYERS}
    for group in svg.select(lambda element: isinstance(element, Group) and element.id in LAYERS):
        for shape in group.select(lambda element: isinstance(element, SvgPath)):
            points = [(p.x, svg.height - p.y) for segment in shape for p in (segment.start, segment.end) if p]
            kept = [points[0]] + [b for a, b in pairwise(points) if a != b]
            layers[group.id].append(np.array(kept))
    return Lines(**layers)


def read_dxf(path: Path) -> Lines:
    """Lines by layer, with ezdxf."""
    layers: dict[str, list[np.ndarray]] = {name: [] for name in LAYERS}
    for line in ezdxf.readfile(path).modelspace().query("LWPOLYLINE"):
        if line.dxf.layer in LAYERS:
            points = np.array([point[:2] for point in line.get_points()])
            layers[line.dxf.layer].append(np.vstack([points, points[:1]]) if line.closed else points)
    return Lines(**layers)


READERS: dict[str, Callable[[Path], Lines]] = {"svg": read_svg, "dxf": read_dxf}


@pytest.fixture(scope="module", params=sorted(READERS))
def sheets(
    request: pytest.FixtureRequest, printed: Printed, tmp_path_factory: pytest.TempPathFactory
) -> list[Lines]:
    folder = tmp_path_factory.mktemp(request.param)
    files = export(printed.layout, folder / f"s.{request.param}", request.param, texture_root=printed.folder)
    return [READERS[request.param](file) for file in files]


def test_every_patch_can_be_cut_out(sheets: list[Lines], printed: Printed) -> None:
    found = [face for lines in sheets for face in faces(lines)]
    matches = match(found, printed.design)
    assert all(matches.values()), [name for name, spots in matches.items() if not spots]
    # congruent patches need as many faces as there are of them
    for spots in matches.values():
        own = {face for face, _ in spots}
        twins = [name for name, others in matches.items() if {face for face, _ in others} == own]
        assert len(own) >= len(twins)


def test_cut_outs_are_patches_and_flaps_alone(sheets: list[Lines], printed: Printed) -> None:
    found = [face for lines in sheets for face in faces(lines)]
    assert len(found) == len(printed.design.patches) + len(printed.layout.flaps)


def test_creases_between_patches_are_those_of_the_design(sheets: list[Lines], printed: Printed) -> None:
    """Each crease on paper with patches on both sides is a hinge: same place in both, folded the same way."""
    design = printed.design
    glued = set(printed.layout.numbers)
    expected = Counter(bends_away(hinge, design) for hinge in design.hinges if hinge.id not in glued)
    seen: Counter[bool] = Counter()
    for lines in sheets:
        found = faces(lines)
        matches = match(found, design)
        for mountain, creases in ((True, lines.mountain), (False, lines.valley)):
            for crease in creases:
                if _hinges_at(crease, found, matches, design):
                    seen[mountain] += 1
                    ways = {bends_away(hinge, design) for hinge in _hinges_at(crease, found, matches, design)}
                    assert mountain in ways
    assert seen == expected


def _hinges_at(crease: np.ndarray, found: list[shapely.Polygon], matches: dict, design: Design) -> list:
    """Hinges of the design that the two faces at a crease can stand for."""
    middle = shapely.Point(crease.mean(axis=0))
    beside = {k for k, face in enumerate(found) if face.distance(middle) < TRUE}
    hinges = []
    for hinge in design.hinges:
        spots = []
        for name in hinge.patches:
            flat = design.patch_by_id[name].plane.flat(hinge.points)
            spots.append({k for k, motion in matches[name] if k in beside and _same(flat, motion, crease)})
        if any(a != b for a in spots[0] for b in spots[1]):
            hinges.append(hinge)
    return hinges


def _same(flat: np.ndarray, motion: np.ndarray, crease: np.ndarray) -> bool:
    moved = flat @ motion[:2, :2].T + motion[:2, 2]
    ends = crease[[0, -1]]
    return bool(min(np.abs(moved - ends).max(), np.abs(moved - ends[::-1]).max()) < TRUE)


def test_the_rebuilding_notices_a_patch_drawn_too_large(sheets: list[Lines], printed: Printed) -> None:
    stretched = [
        Lines(*([line * 1.002 for line in group] for group in (lines.cut, lines.mountain, lines.valley)))
        for lines in sheets
    ]
    found = [face for lines in stretched for face in faces(lines)]
    assert not all(match(found, printed.design).values())
