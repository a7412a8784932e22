"""Reading and writing design.json."""

import json
from pathlib import Path
from typing import Any, NoReturn

from popsim.design.model import FORMAT, VERSION, Design
from popsim.errors import DesignError
from popsim.files import read_bytes

MOST_BYTES = 512 * 2**20
"""Files beyond this are refused unread."""

MOST_PATCHES = 20_000
"""More are refused before any other work is done; verification is meant for thousands."""

MOST_HINGES = 5 * MOST_PATCHES
"""Likewise; contours may cut a hinge into several."""

OUTLINE = '"outline"'
MOST_OUTLINES = 5 * MOST_PATCHES
"""Files in which the word stands more often are refused before they are parsed, which would take minutes."""


def load_design(path: Path) -> Design:
    """Read a design file.

    Raises
    ------
    InputError
        The file cannot be read.
    DesignError
        It is not JSON, not a design of a known version, or breaks a rule of the format.
    """
    content = read_bytes(path, "design")
    if len(content) > MOST_BYTES:
        raise DesignError(
            f"{path}: {len(content) >> 20} MiB is more than the {MOST_BYTES >> 20} MiB that are read"
        )
    return parse_design(content, name=str(path))


def parse_design(content: bytes | str | dict[str, Any], *, name: str = "design") -> Design:
    """Make a design from JSON text, or from the object it holds; `name` stands in the errors.

    Raises
    ------
    DesignError
        As :func:`load_design`.
    """
    from pydantic import ValidationError

    from popsim.design.rules import check_rules

    data = content if isinstance(content, dict) else _read_json(content, name)
    _check_head(data, name)
    try:
        design = Design.model_validate_json(json.dumps(data), strict=True)
    except ValidationError as error:
        raise DesignError(f"{name}: {first_problem(error.errors())}") from None
    try:
        check_rules(design)
    except DesignError as error:
        raise DesignError(f"{name}: {error}") from None
    return design


def missing_textures(design: Design, folder: Path) -> tuple[str, ...]:
    """Texture paths of `design` at which `folder`, where its file lies, holds no file; each once, in order."""
    paths = dict.fromkeys(patch.texture for patch in design.patches if patch.texture is not None)
    return tuple(path for path in paths if not (folder / path).is_file())


def dump_design(design: Design) -> str:
    """JSON text of a design; the same design gives the same text, and reading it back gives the same design."""
    data = design.model_dump(mode="json")
    for patch in data["patches"]:
        if patch["texture_frame"] is None:
            del patch["texture_frame"]
    return (
        json.dumps(data, indent=None, separators=(",", ":"), allow_nan=False).replace('},{"id"', '},\n{"id"')
        + "\n"
    )


def design_schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of design.json."""
    schema = Design.model_json_schema(mode="validation")
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "popsim design",
        **{key: value for key, value in schema.items() if key != "title"},
        "required": ["format", "version", "unit", "card", "patches", "hinges"],
    }


def _read_json(content: bytes | str, name: str) -> dict[str, Any]:
    outlines = content.count(OUTLINE) if isinstance(content, str) else content.count(OUTLINE.encode())
    if outlines > MOST_OUTLINES:
        raise DesignError(
            f"{name}: {outlines} outlines are more than the {MOST_PATCHES} patches that can be handled"
        )

    def refuse(constant: str) -> NoReturn:
        raise DesignError(f"{name}: holds {constant}; all numbers must be finite")

    try:
        data = json.loads(content, parse_constant=refuse)
    except (ValueError, RecursionError) as error:
        if isinstance(error, DesignError):
            raise
        raise DesignError(f"{name}: not a design file, not even JSON ({error})") from None
    if not isinstance(data, dict):
        raise DesignError(f"{name}: not a design file; expected a JSON object, found {type(data).__name__}")
    return data


def _check_head(data: dict[str, Any], name: str) -> None:
    for field, expected in (("format", FORMAT), ("version", VERSION), ("unit", "mm")):
        if field not in data:
            raise DesignError(f"{name}: {field}: missing; a design says {field}: {json.dumps(expected)}")
        if data[field] != expected or isinstance(data[field], bool):
            found = json.dumps(data[field])[:60]
            raise DesignError(f"{name}: {field}: expected {json.dumps(expected)}, found {found}")
    for field, most in (("patches", MOST_PATCHES), ("hinges", MOST_HINGES)):
        if isinstance(data.get(field), list) and len(data[field]) > most:
            raise DesignError(f"{name}: {field}: {len(data[field])} is more than the {most} that can be handled")


def first_problem(errors: list[Any]) -> str:
    """Return in words the first of the errors that pydantic lists: field, what is wrong, how many more."""
    first = errors[0]
    field = ""
    for part in first["loc"]:
        field += f"[{part}]" if isinstance(part, int) else f".{part}" if field else str(part)
    rest = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    return f"{field}: {first['msg'][0].lower()}{first['msg'][1:]}{rest}"
