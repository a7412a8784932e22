"""Every rule of the format, broken one at a time: each error names the field."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from popsim.design import parse_design
from popsim.errors import DesignError

Data = dict[str, Any]


def patch(data: Data, name: str) -> dict[str, Any]:
    return next(patch for patch in data["patches"] if patch["id"] == name)


def hinge(data: Data, first: str, second: str) -> dict[str, Any]:
    return next(hinge for hinge in data["hinges"] if set(hinge["patches"]) == {first, second})


def refused(data: Data, message: str) -> None:
    with pytest.raises(DesignError, match=message):
        parse_design(data)


def test_the_design_that_is_spoiled_here_is_in_order(data: Data) -> None:
    assert len(parse_design(data).patches) == len(data["patches"])


@pytest.mark.parametrize("kind", ["patches", "hinges", "mechanisms"])
def test_ids_are_unique(data: Data, kind: str) -> None:
    data[kind][-1]["id"] = data[kind][0]["id"]
    refused(data, f"{kind}: the id '{data[kind][0]['id']}' is used more than once")


@pytest.mark.parametrize("name", ["", "two words", "x" * 101, "nul\0", "bell\a"])
def test_ids_are_words(data: Data, name: str) -> None:
    patch(data, "M2.T_3")["id"] = name
    refused(data, r"patches\[\d+\]\.id")


@pytest.mark.parametrize("far", [1e7, 1e300])
def test_nothing_is_farther_than_nanometres_can_be_told(data: Data, far: float) -> None:
    patch(data, "M2.T_3")["outline"][0][0] = far
    refused(data, r"patches\[\d+\] \(M2.T_3\): 1e\+\d+ mm is beyond")


@pytest.mark.parametrize("page", ["G", "B"])
def test_both_pages_are_needed(data: Data, page: str) -> None:
    data["patches"] = [each for each in data["patches"] if each["id"] != page]
    data["mechanisms"] = []
    refused(data, f"no patch with the id \"{page}\"|no patch '{page}'")


@pytest.mark.parametrize("page", ["G", "B"])
@pytest.mark.parametrize(("field", "value"), [("depth", 100.0), ("x", [-105.0, 90.0]), ("x", [-90.0, 105.0])])
def test_no_page_reaches_out_of_the_card(data: Data, page: str, field: str, value: object) -> None:
    data["card"] |= {field: value}
    data["patches"].sort(key=lambda each: each["id"] != page)
    refused(data, rf"card\.{field}: the outline of [GB] reaches (48|15) mm out of the card")


def test_a_page_may_be_cut_smaller_than_the_card(data: Data) -> None:
    data["card"] |= {"depth": 160.0, "x": [-120.0, 110.0]}
    assert parse_design(data)


def test_pages_lie_in_their_half_plane(data: Data) -> None:
    patch(data, "G")["outline"][2][1] = -50.0
    refused(data, r"\(G\)\.outline: (must lie in the half plane|not a simple polygon)")


def test_ground_is_level(data: Data) -> None:
    ground = patch(data, "G")
    ground["outline"] = [[x, y, y / 10] for x, y, _ in ground["outline"]]
    refused(data, r"\(G\)\.outline: must lie in the half plane z = 0, y >= 0")


def test_card_has_width(data: Data) -> None:
    data["card"]["x"] = [10.0, 10.0]
    refused(data, r"card\.x")


@pytest.mark.parametrize("value", [0.0, -3.0])
def test_card_has_depth(data: Data, value: float) -> None:
    data["card"]["depth"] = value
    refused(data, r"card\.depth")


def test_paper_is_not_thinner_than_nothing(data: Data) -> None:
    data["card"]["thickness"] = -0.1
    refused(data, r"card\.thickness")


@pytest.mark.parametrize(
    ("outline", "reason"),
    [
        ([[0, 0, 0], [1, 0, 0]], "at least 3"),
        ([[5, 5, 5]] * 4, "encloses no area"),
        ([[0, 0, 0], [5, 0, 0], [9, 0, 0]], "encloses no area"),
        ([[0, 0, 0], [10, 10, 0], [10, 0, 0], [0, 10, 0]], "encloses no area|not a simple polygon"),
        ([[0, 0, 0], [10, 0, 0], [2, 8, 0], [10, 10, 0]], "not a simple polygon"),
        ([[0, 0, 0], [10, 0, 0], [10, 10, 0], [5, -4, 0]], "not a simple polygon"),
        ([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 3]], "not planar"),
        ([[0, 0, 0], [1e-3, 0, 0], [0, 1e-3, 0]], "encloses no area"),
        ([[0, 0, 0], [50, 0, 0], [50, 1e-7, 0]], "encloses"),
        ([["a", 0, 0], [1, 0, 0], [0, 1, 0]], "valid number"),
        ([[0, 0], [1, 0], [0, 1]], "field required"),
        (None, "valid array"),
    ],
)
def test_outline_is_a_simple_planar_polygon(data: Data, outline: object, reason: str) -> None:
    index = [each["id"] for each in data["patches"]].index("M1.F_L")
    data["patches"][index]["outline"] = outline
    refused(data, rf"patches\[{index}\].*outline.*({reason})")


def test_outline_is_not_closed_by_repeating_its_first_point_twice(data: Data) -> None:
    """A repeated first point is harmless and common; it is read."""
    outline = patch(data, "M2.T_3")["outline"]
    outline.append(outline[0])
    assert parse_design(data)


@pytest.mark.parametrize(
    ("hole", "reason"),
    [
        (lambda ring: ring * [1, 1, 1] + [500, 0, 0], "lies? outside|apart"),
        (lambda ring: ring + np.array([0, 1, 0]), "not planar"),
        (lambda ring: ring[:2], "at least 3"),
        (lambda ring: ring[[0, 2, 1, 3]], "holes"),
    ],
    ids=["outside", "off the plane", "two points", "crossing itself"],
)
def test_holes_lie_in_their_patch(data: Data, hole: Callable[[np.ndarray], np.ndarray], reason: str) -> None:
    side = patch(data, "M1.L")
    side["holes"] = [hole(np.array(side["holes"][0])).tolist()]
    refused(data, rf"patches\[\d+\].*holes.*({reason})")


@pytest.mark.parametrize(
    "texture",
    ["../secret.png", "textures/../../x.png", "/etc/passwd", "C:\\x.png", "\\\\host\\x.png", "a\\..\\..\\b.png"],
)
def test_texture_stays_in_the_folder(data: Data, texture: str) -> None:
    patch(data, "M1.R")["texture"] = texture
    refused(data, r"patches\[\d+\] \(M1\.R\)\.texture: .* leads out")


@pytest.mark.parametrize("texture", ["", ".", "./", "a\x00b.png"])
def test_texture_names_a_file(data: Data, texture: str) -> None:
    patch(data, "M1.R")["texture"] = texture
    refused(data, r"\(M1\.R\)\.texture")


def test_hinge_joins_patches_that_exist(data: Data) -> None:
    hinge(data, "M1.L", "M1.F_L")["patches"] = ["M1.L", "M9.F_L"]
    refused(data, r"hinges\[\d+\].*patches: there is no patch 'M9\.F_L'")


def test_missing_patch_is_named_by_its_hinge(data: Data) -> None:
    data["patches"] = [each for each in data["patches"] if each["id"] != "M1.F_L"]
    refused(data, "there is no patch 'M1.F_L'")


def test_hinge_joins_two_patches(data: Data) -> None:
    hinge(data, "M1.L", "M1.F_L")["patches"] = ["M1.L", "M1.L"]
    refused(data, "to itself")


def test_hinge_has_length(data: Data) -> None:
    joined = hinge(data, "M1.L", "M1.F_L")
    joined["axis"][1] = joined["axis"][0]
    refused(data, r"axis: its ends are 0 mm apart")


@pytest.mark.parametrize(
    ("shift", "reason"), [((0.0, 3.0, 0.0), "off the plane of"), ((0.0, 0.0, 300.0), "runs beside")]
)
def test_hinge_lies_in_both_patches(data: Data, shift: tuple[float, ...], reason: str) -> None:
    joined = hinge(data, "M1.L", "M1.F_L")
    joined["axis"] = (np.array(joined["axis"]) + shift).tolist()
    refused(data, rf"hinges\[\d+\].*axis.*{reason}")


def test_hinge_over_a_hole_is_refused(data: Data) -> None:
    side = patch(data, "M1.L")
    middle = np.mean(side["holes"][0], axis=0)
    joined = hinge(data, "M1.L", "M3.tread")
    joined["axis"] = (middle + np.array([[-2, 0, 0], [2, 0, 0]])).tolist()
    refused(data, r"axis: (runs beside M1\.L|lies)")


def test_hinge_is_listed_once(data: Data) -> None:
    again = dict(hinge(data, "M1.L", "M1.F_L"), id="again", patches=["M1.F_L", "M1.L"])
    data["hinges"].append(again)
    refused(data, r"hinges \(\w+, again\): the same hinge is listed twice")


def test_two_patches_turn_about_one_line(data: Data) -> None:
    edges = patch(data, "M1.T_G")["outline"]
    other = dict(hinge(data, "M1.T_G", "M1.C"), id="again", patches=["M1.T_G", "M1.T_B"], crease=[0, 0, -1])
    other["axis"] = [[edges[0][0], 0.0, 40.0], [edges[0][0], 5.0, 40.0]]
    data["hinges"].append(other)
    refused(data, "axis")


def test_one_line_in_two_stretches_is_in_order(data: Data) -> None:
    ridge = hinge(data, "M1.T_G", "M1.C")
    (x0, y, z), (x1, _, _) = ridge["axis"]
    ridge["axis"] = [[x0, y, z], [(x0 + x1) / 2 - 1, y, z]]
    data["hinges"].append(dict(ridge, id="rest", axis=[[(x0 + x1) / 2 + 1, y, z], [x1, y, z]]))
    assert len(parse_design(data).hinges) == len(data["hinges"])


@pytest.mark.parametrize("kind", ["tape", None, "FOLD"])
def test_kind_is_known(data: Data, kind: object) -> None:
    data["hinges"][3]["kind"] = kind
    refused(data, r"hinges\[3\]\.kind")


def test_central_fold_is_there_once(data: Data) -> None:
    data["hinges"] = [each for each in data["hinges"] if each["kind"] != "central"]
    refused(data, "exactly one central fold, found 0")


def test_central_fold_joins_the_pages_alone(data: Data) -> None:
    hinge(data, "M1.L", "M1.F_L")["kind"] = "central"
    refused(data, r"hinges.*kind.*central")


def test_pages_are_joined_by_a_central_fold(data: Data) -> None:
    hinge(data, "G", "B")["kind"] = "fold"
    refused(data, r"hinges.*kind.*central")


def test_central_fold_lies_on_the_x_axis(data: Data) -> None:
    central = hinge(data, "G", "B")
    central["axis"] = [[x, 5.0, 0.0] for x, _, _ in central["axis"]]
    refused(data, r"hinges.*axis.*x axis")


@pytest.mark.parametrize("crease", [None, [0, 0, 1], [1, 0, 1], [0.5, 0, 0], [0, 0, 0]])
def test_flat_crease_says_to_which_side(data: Data, crease: object) -> None:
    hinge(data, "M1.F_L", "M1.F_R")["crease"] = crease
    refused(data, r"hinges\[\d+\].*crease")


def test_flat_crease_may_go_to_either_side(data: Data) -> None:
    hinge(data, "M1.F_L", "M1.F_R")["crease"] = [-1.0, 0.0, 0.0]
    assert parse_design(data)


def test_crease_that_is_not_flat_has_no_side(data: Data) -> None:
    hinge(data, "M1.L", "M1.F_L")["crease"] = [1.0, 0.0, 0.0]
    refused(data, r"crease: must be null")


def test_every_patch_is_reached_through_hinges(data: Data) -> None:
    index = [each["id"] for each in data["patches"]].index("M4.T_G")
    data["hinges"] = [each for each in data["hinges"] if not {"M4.T_G", "M4.T_B"} & set(each["patches"])]
    refused(data, rf"patches\[{index}\] \(M4\.T_G\): no hinges lead to it")


@pytest.mark.parametrize("field", ["base", "patches"])
def test_mechanism_names_patches_that_exist(data: Data, field: str) -> None:
    data["mechanisms"][1][field][0] = "M7.X"
    refused(data, rf"mechanisms\[1\] \(M2\)\.{field}: there is no patch 'M7\.X'")


def test_mechanism_stands_on_two_patches(data: Data) -> None:
    data["mechanisms"][1]["base"] = ["M1.T_G", "M1.T_G"]
    refused(data, r"mechanisms\[1\] \(M2\)\.base")


def test_patch_belongs_to_one_mechanism(data: Data) -> None:
    data["mechanisms"][1]["patches"].append("M1.L")
    refused(data, r"mechanisms\[1\] \(M2\)\.patches: 'M1\.L' belongs to M1 already")


def test_mechanism_does_not_stand_on_itself(data: Data) -> None:
    data["mechanisms"][1]["base"] = data["mechanisms"][1]["patches"][:2]
    refused(data, r"mechanisms\[1\] \(M2\)\.base")


def test_mechanisms_do_not_stand_on_each_other_in_a_ring(data: Data) -> None:
    data["mechanisms"][0]["base"] = ["M3.tread", "M3.riser"]
    refused(data, r"mechanisms\[\d\] \(M\d\)\.base")


def test_patch_and_mechanism_agree_on_each_other(data: Data) -> None:
    patch(data, "M2.T_3")["mechanism"] = "M1"
    refused(data, r"\(M2\.T_3\)\.mechanism")


def test_closing_range_runs_upward(data: Data) -> None:
    data["mechanisms"][0]["closing_range"] = [5.0, -5.0]
    refused(data, r"mechanisms\[0\] \(M1\)\.closing_range")
