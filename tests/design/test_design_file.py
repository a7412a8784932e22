"""design.json: exact round trip, unknown fields, the schema, and files that are no designs."""

import copy
import json
import time
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from popsim.design import Design, Hinge, Patch, dump_design, load_design, parse_design
from popsim.design.file import design_schema
from popsim.errors import DesignError, InputError
from popsim.verification.random_designs import random_design


def test_round_trip_is_exact(design: Design) -> None:
    text = dump_design(design)
    again = parse_design(text)
    assert again == design
    assert dump_design(again) == text


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=15, deadline=None)
def test_round_trip_of_random_designs_is_exact(seed: int) -> None:
    design = random_design(seed, mechanisms=(1, 8)).design
    assert parse_design(dump_design(design)) == design
    assert dump_design(parse_design(dump_design(design))) == dump_design(design)


@given(number=st.floats(allow_nan=False, allow_infinity=False, min_value=1.0, max_value=1e6))
def test_numbers_survive_to_the_last_bit(number: float) -> None:
    patches = tuple(
        Patch(id=name, outline=((-9, 0, 0), (9, 0, 0), (9, sign * number, 0), (-9, sign * number, 0)))
        for name, sign in (("G", 1), ("B", -1))
    )
    fold = Hinge(id="h0", patches=("G", "B"), axis=((-9, 0, 0), (9, 0, 0)), kind="central")
    design = Design(card={"x": (-9.0, 9.0), "depth": number}, patches=patches, hinges=(fold,))
    assert parse_design(dump_design(design)).card.depth == number
    assert parse_design(dump_design(design)) == design


def test_file_round_trip(design: Design, tmp_path: Path) -> None:
    path = tmp_path / "design.json"
    path.write_text(dump_design(design), encoding="utf-8")
    assert load_design(path) == design


@pytest.mark.parametrize("place", ["", "card", "patches", "hinges", "mechanisms", "source"])
def test_unknown_fields_are_kept(data: dict[str, Any], place: str) -> None:
    target = data[place] if place else data
    target = target[0] if isinstance(target, list) else target
    target["colour of the sky"] = {"blue": [1, 2.5, None, "ü"]}
    again = json.loads(dump_design(parse_design(data)))
    assert again == data


def test_optional_fields_may_be_null_or_missing(data: dict[str, Any]) -> None:
    data["source"] = data["model_to_card"] = None
    for patch in data["patches"]:
        del patch["texture"], patch["holes"], patch["role"]
    for mechanism in data["mechanisms"]:
        mechanism["parameters"] = {"written by": "another program"}
        del mechanism["closing_range"]
    for hinge in data["hinges"]:
        if hinge["crease"] is None:
            del hinge["crease"]
    design = parse_design(data)
    assert design.source is None
    assert design.patches[0].texture is None


@pytest.mark.parametrize("mechanisms", [{"mechanisms": []}, {}])
def test_mechanisms_may_be_absent(data: dict[str, Any], mechanisms: dict[str, Any]) -> None:
    del data["mechanisms"]
    for patch in data["patches"]:
        patch["mechanism"] = None
    assert parse_design(data | mechanisms).mechanisms == ()
    jsonschema.validate(data | mechanisms, design_schema())


def test_designs_meet_the_published_schema(data: dict[str, Any]) -> None:
    schema = design_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(data, schema)


@pytest.mark.parametrize("field", ["format", "version", "unit", "card", "patches", "hinges"])
def test_schema_and_reader_both_refuse_a_missing_field(data: dict[str, Any], field: str) -> None:
    del data[field]
    with pytest.raises(jsonschema.ValidationError, match=field):
        jsonschema.validate(data, design_schema())
    with pytest.raises(DesignError, match=field):
        parse_design(data)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("unit",), "inch"),
        (("version",), 2),
        (("card", "depth"), -1.0),
        (("card", "x"), [0.0]),
        (("patches", 0, "outline"), [[0, 0, 0], [1, 0, 0]]),
        (("patches", 0, "outline", 0), [0, 0]),
        (("hinges", 0, "kind"), "tape"),
        (("hinges", 0, "patches"), ["G"]),
        (("mechanisms", 0, "base"), "G"),
    ],
)
def test_schema_and_reader_refuse_the_same(
    data: dict[str, Any], path: tuple[str | int, ...], value: object
) -> None:
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(_with(data, path, value), design_schema())
    with pytest.raises(DesignError, match=str(path[0])):
        parse_design(_with(data, path, value))


@pytest.mark.parametrize("text", ["", "{", "pop-up", "\x00\x01", "[1, 2", '{"format": "popsim-design",}'])
def test_not_json(text: str) -> None:
    with pytest.raises(DesignError, match="not even JSON"):
        parse_design(text)


@pytest.mark.parametrize("text", ["[]", "3", '"design"', "null"])
def test_json_but_no_object(text: str) -> None:
    with pytest.raises(DesignError, match="expected a JSON object"):
        parse_design(text)


def test_deeply_nested_json_is_refused() -> None:
    with pytest.raises(DesignError, match="not even JSON"):
        parse_design("[" * 100_000)


def test_not_utf8_is_refused(design: Design) -> None:
    with pytest.raises(DesignError, match="not even JSON"):
        parse_design(dump_design(design).encode("utf-16")[3:])


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity"])
def test_numbers_that_are_none(design: Design, number: str) -> None:
    with pytest.raises(DesignError, match=number):
        parse_design(dump_design(design).replace("148.0", number, 1))


def test_number_beyond_all_bounds_is_refused(design: Design) -> None:
    with pytest.raises(DesignError, match=r"card\.depth"):
        parse_design(dump_design(design).replace('"depth":148.0', '"depth":1e999', 1))


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_nan_in_data_is_refused(data: dict[str, Any], value: float) -> None:
    data["patches"][3]["outline"][0][0] = value
    with pytest.raises(DesignError, match=r"patches\[3\].*outline"):
        parse_design(data)


@pytest.mark.parametrize("version", [0, 2, "1", None, True, 1.5])
def test_unknown_version(data: dict[str, Any], version: object) -> None:
    data["version"] = version
    with pytest.raises(DesignError, match="version: expected 1"):
        parse_design(data)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        load_design(tmp_path / "none.json")


def test_errors_name_the_file(tmp_path: Path) -> None:
    path = tmp_path / "broken.json"
    path.write_text("{}")
    with pytest.raises(DesignError, match=r"broken\.json: format: missing"):
        load_design(path)


def test_a_million_patches_are_refused_before_the_file_is_parsed() -> None:
    with pytest.raises(DesignError, match="1000000 outlines are more than the 20000 patches"):
        parse_design(b'{"patches": [' + b'{"outline": [], ' * 1_000_000)


@pytest.mark.parametrize(("field", "most"), [("patches", 20_000), ("hinges", 100_000)])
def test_a_million_are_refused_before_any_is_looked_at(data: dict[str, Any], field: str, most: int) -> None:
    data[field] = [data[field][0]] * 1_000_000
    start = time.perf_counter()
    with pytest.raises(DesignError, match=f"{field}: 1000000 is more than the {most}"):
        parse_design(data)
    assert time.perf_counter() - start < 1.0


def _with(data: dict[str, Any], path: tuple[str | int, ...], value: object) -> dict[str, Any]:
    """A copy of nested data with one value replaced."""
    changed = copy.deepcopy(data)
    target: Any = changed
    for key in path[:-1]:
        target = target[key]
    target[path[-1]] = value
    return changed


def test_a_copy_with_other_fields_derives_anew(design: Design) -> None:
    before = design.patch_by_id["M1.L"]
    assert before.points.shape == (len(before.outline), 3)
    moved = before.model_copy(update={"outline": before.outline[:3]})
    assert moved.points.tolist() == [list(point) for point in before.outline[:3]]
    other = design.model_copy(update={"patches": (moved,)})
    assert other.patch_by_id == {"M1.L": moved}
