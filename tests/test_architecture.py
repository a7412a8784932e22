"""The dependency arrow runs one way, and each heavy package lives in one room."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent / "popsim"

STOREYS = [
    {"errors", ""},
    {"files", "units", "stock", "beside", "garbage", "wording"},
    {"geometry"},
    {"design"},
    {"mechanisms"},
    {"validity"},
    {"mesh", "rendering"},
    {"fitting", "patches"},
    {"simulation", "layout"},
    {"verification", "assembly", "gluing"},
    {"export", "pictures"},
    {"booklet"},
    {"pipeline"},
    {"cli"},
    {"__main__"},
]
"""Packages from the ground up; each imports only itself and what lies below."""

ROOMS = {
    "trimesh": {"mesh"},
    "mujoco": {"simulation"},
    "pyrender": {"rendering"},
    "OpenGL": {"rendering"},
    "embreex": {"rendering"},
    "numba": {"fitting"},
    "cv2": {"fitting", "patches", "rendering"},
    "reportlab": {"export"},
    "yaml": {"pipeline"},
    "drawsvg": {"export"},
    "ezdxf": {"export"},
    "typer": {"cli"},
    "rich": {"cli"},
}
"""Who may import what."""

FILES = sorted(ROOT.rglob("*.py"))


def package_of(path: Path) -> str:
    inside = path.relative_to(ROOT)
    return inside.parts[0] if len(inside.parts) > 1 else inside.stem.replace("__init__", "")


def storey(package: str) -> int:
    return next(level for level, names in enumerate(STOREYS) if package in names)


def imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports relatively"
            yield node.module or ""


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_file_imports_from_below_and_keeps_to_its_room(path: Path) -> None:
    own = package_of(path)
    for name in imports(path):
        top, *rest = name.split(".")
        if top == "popsim":
            other = rest[0] if rest else ""
            assert other == own or storey(other) < storey(own), f"{own} imports {name}"
        elif top in ROOMS:
            assert own in ROOMS[top], f"{own} imports {top}, which lives in {ROOMS[top]}"


def test_every_package_has_a_storey() -> None:
    assert {package_of(path) for path in FILES} <= set().union(*STOREYS)


FLAWS = ROOT / "verification" / "random_designs" / "box_flaws.py"
"""Negative controls: they spoil particular mechanisms on purpose."""


def test_only_mechanisms_ask_which_mechanism_it_is() -> None:
    """No file outside a mechanism's own names a mechanism's class or its type."""
    names = ("BoxFold", "TentFold", "StepFold", "VFold", '"box-fold"', '"tent-fold"', '"step-fold"', '"v-fold')
    found = [
        f"{path.relative_to(ROOT)}: {name}"
        for path in FILES
        if package_of(path) != "mechanisms" and path != FLAWS
        for name in names
        if name in path.read_text()
    ]
    assert found == []
