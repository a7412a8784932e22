"""From mechanisms and a model to contoured, printed patches that fold."""

from io import BytesIO

import numpy as np
import pytest
from oracles.closed_form import closed_form_poses
from oracles.crossing import crossings
from patch_solids import BLUE, CYAN, GREEN, RED, YELLOW, box_of, coloured_box, joined, slab
from PIL import Image
from shapely import hausdorff_distance, unary_union
from shapely.affinity import rotate
from shapely.geometry import Point, Polygon, box

from popsim.beside import begun
from popsim.design import Card, dump_design
from popsim.errors import GeometryError
from popsim.geometry.surface import Material, Surface
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold, Top
from popsim.mechanisms.step_fold import StepFold
from popsim.mechanisms.tent_fold import TentFold
from popsim.patches import PatchSettings, paint
from popsim.rendering.paint import PAPER
from popsim.validity import examine

CARD = Card(x=(-200, 200), depth=250)
COARSE = PatchSettings(dpi=75)
ANGLES = np.radians([175.0, 150.0, 120.0, 90.0, 60.0, 30.0, 8.0])


def box_fold(*tops, width=30.0):
    return BoxFold.stepped("M1", card_pair(CARD), width, tops or (Top(-50, 50, 40),))


def painted(mechanisms, surface, **options):
    return paint(mechanisms, surface, {m.id: box_of(surface) for m in mechanisms}, COARSE, **options)


def area(ring):
    a, b = ring, np.roll(ring, -1, axis=0)
    return float(np.linalg.norm(np.cross(a, b).sum(axis=0))) / 2


@pytest.fixture(scope="module")
def plain_box():
    return painted([box_fold()], coloured_box((-50, -30, 0), (50, 30, 40)))


def test_the_patches_of_a_box_are_its_faces(plain_box):
    for plate in box_fold().plates():
        shape = plain_box.shapes[f"M1.{plate.role}"]
        assert area(shape.outline) == pytest.approx(area(plate.outline), rel=1e-3), plate.role
        assert np.abs(shape.outline.max(axis=0) - plate.outline.max(axis=0)).max() < 0.26
        assert shape.holes == ()


def test_each_patch_is_printed_with_the_side_it_shows(plain_box):
    colours = {"F_L": RED, "B_R": GREEN, "L": BLUE, "R": YELLOW, "T_G": CYAN, "T_B": CYAN}
    for role, colour in colours.items():
        image = np.asarray(Image.open(BytesIO(plain_box.images[f"textures/M1.{role}.png"])))
        assert image.ndim == 3
        assert (image == np.rint(colour[:3] * 255)).all(), role
    assert plain_box.shapes["M1.C"].texture is None


def test_figures_and_notes(plain_box):
    assert plain_box.notes == ()
    assert plain_box.renderer == "rays"
    assert plain_box.vertices == 4 * 9
    assert plain_box.coverage["M1"] == pytest.approx(1.0, abs=0.01)
    expected = 3 * 280 + 2 * 260 + 4 * 140
    assert plain_box.cut_length == pytest.approx(expected, rel=1e-3)


def test_print_covers_the_bleed_and_reads_from_outside(plain_box):
    shape = plain_box.shapes["M1.L"]
    frame = shape.texture_frame
    origin, right, up = (np.array(part) for part in (frame.origin, frame.right, frame.up))
    assert np.cross(right, up)[1] > 0
    rel = shape.outline - origin
    for edge in (right, up):
        along = rel @ edge / np.linalg.norm(edge)
        assert along.min() == pytest.approx(1.5, abs=0.01)
        assert np.linalg.norm(edge) - along.max() >= 1.5 - 1e-6


def test_the_same_input_gives_the_same_bytes(plain_box):
    again = painted([box_fold()], coloured_box((-50, -30, 0), (50, 30, 40)))
    assert again.images == plain_box.images
    assert all(np.array_equal(again.shapes[k].outline, plain_box.shapes[k].outline) for k in again.shapes)


def test_printing_leaves_no_threads_of_opencv_that_a_forked_process_would_wait_for(plain_box):
    import cv2

    assert plain_box.images
    assert cv2.getNumThreads() == 1
    assert begun(cv2.setNumThreads, [1])() == [None]


def truck():
    """A body with a gap below it, a bonnet, a bumper, and a parapet at each side of the roof."""
    return joined(
        coloured_box((-50, -30, 10), (20, 30, 40)),
        coloured_box((20, -30, 10), (50, 30, 25)),
        coloured_box((-40, -30, 0), (-25, 30, 10)),
        coloured_box((25, -30, 0), (40, 30, 10)),
        coloured_box((50, -30, 10), (54, 30, 16)),
        coloured_box((-50, 29, 40), (0, 30, 46)),
        coloured_box((-50, -30, 40), (0, -29, 46)),
    )


@pytest.fixture(scope="module")
def truck_fold():
    return box_fold(Top(-50, 20, 40), Top(20, 50, 25))


@pytest.fixture(scope="module")
def truck_design(truck_fold):
    return assemble(CARD, [truck_fold], painted([truck_fold], truck(), prints=False).shapes)


def test_sides_follow_wheels_bumper_and_parapet(truck_design):
    side = truck_design.patch_by_id["M1.L"]
    low, high = side.points.min(axis=0), side.points.max(axis=0)
    assert (low[0], low[2]) == pytest.approx((-50, 0), abs=0.3)
    assert (high[0], high[2]) == pytest.approx((54, 46), abs=0.3)
    polygon = side.plane.polygon(side.points)
    expected = 70 * 30 + 30 * 15 + 2 * 150 + 4 * 6 + 50 * 6
    assert polygon.area == pytest.approx(expected, rel=0.01)


def test_hinges_lie_on_the_wheels_only(truck_design):
    feet = [h for h in truck_design.hinges if h.patches == ("G", "M1.L")]
    spans = sorted(tuple(sorted(h.points[:, 0])) for h in feet)
    assert np.allclose(spans, [(-40, -25), (25, 40)], atol=0.6)
    assert all(np.abs(h.points[:, 2]).max() == 0 for h in feet)


def test_contours_leave_the_theory_as_it_was(truck_design, truck_fold):
    theory = examine(truck_design)
    assert theory.holds
    found = theory.mechanisms["M1"]
    assert found.half_width == truck_fold.half_width
    assert [top.height for top in found.tops] == [40, 25]


def test_contours_cross_nothing_while_closing(truck_design):
    assert list(crossings(truck_design, closed_form_poses(truck_design, ANGLES), ANGLES, 0.05)) == []


def test_patches_named_stay_within_their_faces(truck_fold):
    held = PatchSettings(dpi=75, within_face=frozenset({"M1.L"}))
    surface = truck()
    shapes = paint([truck_fold], surface, {"M1": box_of(surface)}, held, prints=False).shapes
    assert shapes["M1.L"].outline[:, 0].max() == pytest.approx(50, abs=0.01)
    assert shapes["M1.R"].outline[:, 0].max() == pytest.approx(54, abs=0.3)


def test_the_backbone_stays_inside_the_sides(truck_design):
    from shapely.geometry import Polygon

    sides, spine = (Polygon(truck_design.patch_by_id[name].points[:, [0, 2]]) for name in ("M1.L", "M1.C"))
    assert spine.within(sides.buffer(0.5))


def test_a_doorway_is_a_dent_and_not_a_gap():
    wall = joined(
        coloured_box((-50, -30, 0), (20, 30, 40)),
        coloured_box((20, 8, 0), (50, 30, 40)),
        coloured_box((20, -30, 0), (50, -8, 40)),
        coloured_box((20, -8, 20), (50, 8, 40)),
    )
    shapes = painted([box_fold()], wall, prints=False).shapes
    assert area(shapes["M1.F_L"].outline) == pytest.approx(30 * 40, rel=0.01)


def test_a_passage_through_is_a_gap():
    gate = joined(
        coloured_box((-50, 10, 0), (50, 30, 40)),
        coloured_box((-50, -30, 0), (50, -10, 40)),
        coloured_box((-50, -10, 20), (50, 10, 40)),
    )
    shapes = painted([box_fold()], gate, prints=False).shapes
    assert area(shapes["M1.F_L"].outline) == pytest.approx(30 * 40 - 10 * 20, rel=0.02)


def test_eaves_of_a_roof_reach_past_the_walls_it_stands_on():
    walls = box_fold()
    top = next(pair for pair in walls.pairs() if pair.kind.value == "opening")
    roof = TentFold("M2", top, (-50, 50), 30, 20)
    slopes = [np.array([[-50, 0, 60], [50, 0, 60], [50, s * 36, 36], [-50, s * 36, 36]], float) for s in (1, -1)]
    house = coloured_box((-50, -30, 0), (50, 30, 40))
    triangles = np.array([ring[list(k)] for ring in slopes for k in ((0, 1, 2), (0, 2, 3))])
    surface = joined(house, type(house)(triangles, np.zeros((4, 3, 2)), np.zeros(4, int), house.materials))
    shapes = painted([walls, roof], surface, prints=False).shapes
    assert shapes["M2.T_3"].outline[:, 1].max() == pytest.approx(36, abs=0.4)
    design = assemble(CARD, [walls, roof], shapes)
    assert examine(design).holds
    assert list(crossings(design, closed_form_poses(design, ANGLES), ANGLES, 0.05)) == []
    dump_design(design)


def test_a_mechanism_without_a_territory_is_refused():
    with pytest.raises(GeometryError, match="M1 has no territory"):
        paint([box_fold()], coloured_box((-50, -30, 0), (50, 30, 40)), {})


def test_a_model_that_is_elsewhere_leaves_plain_faces_with_notes():
    shapes = painted([box_fold()], coloured_box((300, 300, 300), (310, 310, 310)))
    assert shapes.images == {}
    assert shapes.coverage == {"M1": 0.0}
    assert len([note for note in shapes.notes if "strips" in note]) > 0
    assert assemble(CARD, [box_fold()], shapes.shapes)


def test_pairs_show_mirrors_beyond_the_sides_and_cross_nothing():
    wide = joined(
        coloured_box((-50, -30, 0), (50, 30, 40)),
        coloured_box((46, 30, 25), (50, 38, 33)),
        coloured_box((46, -38, 25), (50, -30, 33)),
    )
    box = box_fold()
    design = assemble(CARD, [box], painted([box], wide, prints=False).shapes)
    front = design.patch_by_id["M1.F_L"].points
    assert front[:, 1].max() == pytest.approx(38, abs=0.4)
    assert examine(design).holds
    assert list(crossings(design, closed_form_poses(design, ANGLES), ANGLES, 0.05)) == []
    assert {h.kind for h in design.hinges if h.patches == ("M1.L", "M1.F_L")} == {"glue"}


def test_ears_leave_the_corner_to_the_step_that_stands_there():
    walls = box_fold()
    corner = next(pair for pair in walls.pairs() if pair.kind.value == "corner" and pair.side.value > 0)
    step = StepFold("M2", corner, (20, 50), 15, 30)
    wide = joined(
        coloured_box((-50, -30, 0), (50, 30, 40)),
        coloured_box((46, 30, 20), (50, 38, 36)),
        coloured_box((46, -38, 20), (50, -30, 36)),
        coloured_box((20, 30, 0), (50, 45, 30)),
    )
    design = assemble(CARD, [walls, step], painted([walls, step], wide, prints=False).shapes)
    assert design.patch_by_id["M1.F_L"].points[:, 1].max() == pytest.approx(30, abs=1e-6)
    assert design.patch_by_id["M1.F_R"].points[:, 1].min() == pytest.approx(-38, abs=0.4)
    assert list(crossings(design, closed_form_poses(design, ANGLES), ANGLES, 0.05)) == []


def test_a_gap_beside_an_edge_is_closed_and_one_at_the_ground_stays():
    narrow = joined(coloured_box((-50, -27.5, 3), (50, 27.5, 40)), coloured_box((-10, -30, 0), (10, 30, 40)))
    shapes = painted([box_fold()], narrow, prints=False).shapes
    front, side = shapes["M1.F_L"].outline, shapes["M1.L"].outline
    assert front[:, 1].max() == pytest.approx(30, abs=1e-6)
    edge = front[np.abs(front[:, 1] - 30) < 1e-6, 2]
    assert np.ptp(edge) == pytest.approx(37, abs=0.5)
    foot = side[np.abs(side[:, 2]) < 1e-6, 0]
    assert np.ptp(foot) < 60


def test_models_without_colours_print_as_paper_with_creases():
    body = joined(coloured_box((-50, -30, 0), (50, 30, 40)), coloured_box((-20, -34, 10), (20, 34, 25)))
    plain = Surface(body.triangles, body.uv, np.zeros_like(body.material), (Material(np.full(4, 0.6)),))
    image = Image.open(BytesIO(painted([box_fold()], plain).images["textures/M1.L.png"]))
    pixels = np.asarray(image).astype(int)
    paper = np.rint(PAPER * 255).astype(int)
    assert (np.abs(pixels - paper).max(axis=2) <= 1).mean() > 0.9
    dark = pixels.max(axis=2) < 0.6 * paper.min()
    height, width = dark.shape
    assert not dark[:6].any() and not dark[:, :6].any()  # outlines are the edges of the paper
    assert dark[:, width // 2].any() and dark[height // 2].any()


def test_colours_of_corners_run_over_a_print_as_they_do_over_the_model():
    plain = coloured_box((-50, -30, 0), (50, 30, 40))
    red = (plain.triangles[..., 0] + 50) / 100
    colours = np.stack([red, np.zeros_like(red), 1 - red, np.ones_like(red)], axis=-1)
    shaded = Surface(plain.triangles, plain.uv, np.zeros_like(plain.material), (Material(np.ones(4)),), colours)
    made = painted([box_fold()], shaded)
    image = np.asarray(Image.open(BytesIO(made.images["textures/M1.L.png"]))).astype(int)
    frame = made.shapes["M1.L"].texture_frame
    across = (np.arange(image.shape[1]) + 0.5) / image.shape[1]
    x = np.clip(frame.origin[0] + across * frame.right[0], -50, 50)
    expected = 255 * (x + 50) / 100
    assert np.abs(image[..., 0] - expected).max() <= 3
    assert np.abs(image[..., 2] - (255 - expected)).max() <= 3
    assert image[..., 1].max() == 0


def fence(behind):
    """A box whose side at y = 30 has a transparent square in its texture, 24 by 24, amid its 100 by 40."""
    body = coloured_box((-50, -30, 0), (50, 30, 40))
    side = (body.triangles[..., 1] == 30).all(axis=1)
    picture = np.full((40, 100, 4), (200, 0, 0, 255), dtype=np.uint8)
    picture[8:32, 38:62, 3] = 0
    uv = np.zeros_like(body.uv)
    uv[side] = (body.triangles[side][..., [0, 2]] - (-50, 0)) / (100, 40)
    gone = (
        np.zeros(len(side), dtype=bool) if behind else ~side & (np.abs(body.triangles[..., 1]) == 30).all(axis=1)
    )
    materials = (*body.materials, Material(np.ones(4), picture))
    return Surface(
        body.triangles[~gone], uv[~gone], np.where(side, len(body.materials), body.material)[~gone], materials
    )


def test_what_is_seen_through_a_transparent_part_of_a_texture_is_printed_there():
    made = painted([box_fold()], fence(behind=True))
    image = np.asarray(Image.open(BytesIO(made.images["textures/M1.L.png"])))
    rows, columns = image.shape[:2]
    assert (image[rows // 2, columns // 2] == np.rint(YELLOW[:3] * 255)).all()  # the far side
    assert (image[rows // 2, columns // 5] == (200, 0, 0)).all()


def test_where_nothing_lies_behind_a_transparent_part_there_is_a_window():
    made = painted([box_fold()], fence(behind=False))
    (hole,) = made.shapes["M1.L"].holes
    assert np.ptp(hole[:, 0]) == pytest.approx(24, abs=0.7)
    assert np.ptp(hole[:, 2]) == pytest.approx(24, abs=0.7)


@pytest.mark.parametrize("turn", [0.0, 25.0, 45.0])
def test_outlines_stay_within_half_a_millimetre_of_the_silhouette(turn):
    """Where no hinge is near: round wheels, an arch, a round and a turned window."""
    wheels = [Point(x, 9).buffer(9, 64) for x in (-30, 30)]
    windows = [Point(-20, 28).buffer(7, 64), rotate(box(12, 21, 28, 35), turn)]
    body = unary_union([box(-50, 8, 50, 40), *wheels]).difference(
        unary_union([Point(0, 8).buffer(7, 64), *windows])
    )
    shapes = painted([box_fold()], slab(body, -30, 30), prints=False).shapes
    side = shapes["M1.L"]
    assert len(side.holes) == 2
    found = Polygon(side.outline[:, [0, 2]], [hole[:, [0, 2]] for hole in side.holes])
    free = box(-45, 3, 45, 37)
    ours, theirs = (shape.boundary.intersection(free) for shape in (found, body))
    assert hausdorff_distance(ours, theirs, densify=0.02) < 0.5
    assert found.buffer(-1.0).buffer(1.0).symmetric_difference(found).area < 0.01 * found.area  # no slivers
