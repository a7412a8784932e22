"""Properties that every format keeps."""

import json
from pathlib import Path
from typing import Any

import ezdxf
import networkx as nx
import numpy as np
import pytest
from printed_design import Printed

from popsim.errors import InputError, OutputError
from popsim.export import FORMATS, STYLES, Printing, export
from popsim.simulation import fold_design


@pytest.mark.parametrize("name", sorted(FORMATS))
def test_same_layout_same_bytes(name: str, printed: Printed, tmp_path: Path) -> None:
    made = []
    for folder in ("one", "other"):
        files = export(
            printed.layout,
            tmp_path / folder / f"s.{name}",
            name,
            texture_root=printed.folder,
            plan=printed.plan,
            printing=Printing(footer="popsim"),
        )
        made.append([file.read_bytes() for file in files])
    assert made[0] == made[1]


@pytest.mark.parametrize("name", sorted(FORMATS))
def test_nothing_is_overwritten_without_leave(name: str, printed: Printed, tmp_path: Path) -> None:
    path = tmp_path / f"s.{name}"
    files = export(printed.layout, path, name, texture_root=printed.folder)
    before = [file.read_bytes() for file in files]
    with pytest.raises(OutputError, match="exists"):
        export(printed.layout, path, name, texture_root=printed.folder, printing=Printing(banner="other"))
    assert [file.read_bytes() for file in files] == before
    export(printed.layout, path, name, texture_root=printed.folder, force=True)


@pytest.mark.parametrize("style", sorted(STYLES))
def test_styles_never_rely_on_colour_alone(style: str) -> None:
    looks = {
        (stroke.dashes) for role, stroke in STYLES[style].strokes.items() if role.value in ("mountain", "valley")
    }
    assert len(looks) == 2
    assert () not in looks


def test_unknown_names_are_refused_with_the_known(printed: Printed, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="pdf"):
        export(printed.layout, tmp_path / "s.xyz", "xyz", texture_root=printed.folder)
    with pytest.raises(InputError, match="origami"):
        export(
            printed.layout, tmp_path / "s.pdf", "pdf", texture_root=printed.folder, printing=Printing("baroque")
        )


def test_a_missing_picture_is_named_and_nothing_is_left(printed: Printed, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"M1\.L|texture"):
        export(printed.layout, tmp_path / "s.pdf", "pdf", texture_root=tmp_path / "nowhere")
    assert not list(tmp_path.iterdir())


def test_dxf_passes_the_audit_in_millimetres(printed: Printed, tmp_path: Path) -> None:
    for file in export(printed.layout, tmp_path / "s.dxf", "dxf", texture_root=printed.folder):
        document = ezdxf.readfile(file)
        audit = document.audit()
        assert not audit.errors
        assert not audit.fixes
        assert document.header["$INSUNITS"] == 4
        cuts = document.modelspace().query('LWPOLYLINE[layer=="cut"]')
        assert all(line.closed or len(line) >= 2 for line in cuts)


def faces_of_edges(frame: dict[str, Any]) -> dict[frozenset[int], list[int]]:
    found: dict[frozenset[int], list[int]] = {frozenset(edge): [] for edge in frame["edges_vertices"]}
    for number, face in enumerate(frame["faces_vertices"]):
        for pair in zip(face, face[1:] + face[:1], strict=True):
            found[frozenset(pair)].append(number)
    return found


def faces_of_paper(frame: dict[str, Any]) -> int:
    """How many are left where triangles of one face are put together."""
    faces = nx.Graph()
    faces.add_nodes_from(range(len(frame["faces_vertices"])))
    shared = faces_of_edges(frame).values()
    faces.add_edges_from(pair for pair, mark in zip(shared, frame["edges_assignment"], strict=True) if mark == "F")
    return nx.number_connected_components(faces)


def test_fold_says_how_far_creases_bend_while_the_card_is_half_open(printed: Printed, tmp_path: Path) -> None:
    sweep = fold_design(printed.design, 36).sweep
    files = export(printed.layout, tmp_path / "s.fold", "fold", texture_root=printed.folder, sweep=sweep)
    signs = {"M": -1, "V": 1, "F": 0, "B": 0}
    angles = set()
    for file in files:
        frame = json.loads(file.read_text())
        marks, bends = frame["edges_assignment"], frame["edges_foldAngle"]
        for mark, bend, faces in zip(marks, bends, faces_of_edges(frame).values(), strict=True):
            assert np.sign(bend) == signs[mark]
            assert len(faces) == (1 if mark == "B" else 2)  # cuts are two borders
        angles |= {round(bend) for bend in bends}
        places = np.array(frame["vertices_coords"])
        ends = places[np.array(frame["edges_vertices"])]
        assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).min() > 0.1  # no slivers
    # sides and tops of boxes bend by 45 and 135 degrees where the card stands at 90, the card itself by 90
    assert {-135, -45, 45, 90, 135} <= angles


def test_without_the_motion_fold_says_nothing_of_angles(printed: Printed, tmp_path: Path) -> None:
    file, *_ = export(printed.layout, tmp_path / "s.fold", "fold", texture_root=printed.folder)
    assert "edges_foldAngle" not in json.loads(file.read_text())


def test_fold_has_faces_and_assignments(printed: Printed, tmp_path: Path) -> None:
    sweep = fold_design(printed.design, 36).sweep
    file, *pieces = export(printed.layout, tmp_path / "s.fold", "fold", texture_root=printed.folder, sweep=sweep)
    data = json.loads(file.read_text())
    assert data["file_spec"] == 1.2
    assert len(pieces) == len(printed.layout.pieces)
    opened, *folding = data["file_frames"]
    for frame in (data, opened, *(json.loads(piece.read_text()) for piece in pieces)):
        count = len(frame["vertices_coords"])
        assert len(frame["edges_vertices"]) == len(frame["edges_assignment"])
        assert {v for face in frame["faces_vertices"] for v in face} == set(range(count))
        edges = {frozenset(edge) for edge in frame["edges_vertices"]}
        for face in frame["faces_vertices"]:
            assert all(frozenset(pair) in edges for pair in zip(face, face[1:] + face[:1], strict=True))
    folds = [fold for piece in printed.layout.pieces for fold in piece.folds]
    assert sum(mark in "MV" for mark in data["edges_assignment"]) >= len(folds)
    ends = np.array(data["vertices_coords"])[np.array(data["edges_vertices"])]
    bent = np.array([mark in "MV" for mark in data["edges_assignment"]])
    lengths = sum(float(np.linalg.norm(fold.ends[1] - fold.ends[0])) for fold in folds)
    assert np.linalg.norm(ends[bent, 1] - ends[bent, 0], axis=1).sum() == pytest.approx(lengths, rel=0.002)
    assert faces_of_paper(data) == len(printed.design.patches) + len(printed.layout.flaps)
    assert len(opened["popsim:glue"]) == len(printed.layout.flaps)
    angles = [frame["popsim:fold_angle"] for frame in folding]
    assert angles == pytest.approx(list(range(165, -1, -15)))
    for frame in folding:
        assert frame["frame_inherit"] and frame["frame_parent"] == 1
        assert len(frame["vertices_coords"]) == len(opened["vertices_coords"])
    closed = np.array(folding[-1]["vertices_coords"])
    assert np.abs(closed[:, 1]).max() < 0.05  # flat in the plane that bisects the card
