"""What is written is read back with other libraries, cut out, and compared with the design."""

from collections import Counter

import numpy as np
import pytest
import shapely
from printed_design import Printed
from rebuild import TRUE, bends_away, faces, match
from sheet_readers import READERS, Side

from popsim.design import Design
from popsim.export import export


@pytest.fixture(scope="module", params=sorted(READERS))
def sheets(
    request: pytest.FixtureRequest, printed: Printed, tmp_path_factory: pytest.TempPathFactory
) -> list[Side]:
    folder = tmp_path_factory.mktemp(request.param)
    files = export(printed.layout, folder / f"s.{request.param}", request.param, texture_root=printed.folder)
    return [side for file in files for side in READERS[request.param](file)]


def test_every_patch_can_be_cut_out(sheets: list[Side], printed: Printed) -> None:
    found = [face for lines in sheets for face in faces(lines)]
    matches = match(found, printed.design)
    assert all(matches.values()), [name for name, spots in matches.items() if not spots]
    # congruent patches need as many faces as there are of them
    for spots in matches.values():
        own = {face for face, _ in spots}
        twins = [name for name, others in matches.items() if {face for face, _ in others} == own]
        assert len(own) >= len(twins)


def test_cut_outs_are_patches_and_flaps_alone(sheets: list[Side], printed: Printed) -> None:
    found = [face for lines in sheets for face in faces(lines)]
    assert len(found) == len(printed.design.patches) + len(printed.layout.flaps)


def test_creases_between_patches_are_those_of_the_design(sheets: list[Side], printed: Printed) -> None:
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


def test_the_rebuilding_notices_a_patch_drawn_too_large(sheets: list[Side], printed: Printed) -> None:
    stretched = [
        Side(*([line * 1.002 for line in group] for group in (lines.cut, lines.mountain, lines.valley)))
        for lines in sheets
    ]
    found = [face for lines in stretched for face in faces(lines)]
    assert not all(match(found, printed.design).values())
