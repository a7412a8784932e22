"""Help, schema, verdicts."""

import json
import subprocess
import sys
from pathlib import Path

import jsonschema

from popsim import __version__
from popsim.design import Card, dump_design
from popsim.mechanisms import assemble, card_pair
from popsim.mechanisms.box_fold import BoxFold

HEAVY = ("trimesh", "mujoco", "pyrender", "reportlab", "scipy", "skimage", "shapely", "numpy", "pydantic")


def test_help_imports_nothing_heavy() -> None:
    code = (
        f"import sys\nfrom popsim.cli.app import app\nprint([name for name in {HEAVY!r} if name in sys.modules])\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_version_and_help(popsim) -> None:
    assert popsim("--version").stdout.strip() == f"popsim {__version__}"
    done = popsim("--help")
    assert done.returncode == 0
    assert all(word in done.stdout for word in ("design", "verify", "schema"))


def test_validate_confirms_the_conditions_and_writes_a_report(popsim, popsim_main, tmp_path: Path) -> None:
    done = popsim("validate", "--count", 6, "--seed", 3, "-o", "campaign")
    assert done.returncode == 0, done.stdout + done.stderr
    report = json.loads((tmp_path / "campaign" / "report.json").read_text())
    assert report["designs"] == 6 and report["passed"] is True
    assert "PASSED 6 designs" in done.stdout
    again = popsim_main("validate", "--count", 6, "-o", "campaign")
    assert again.returncode == 2 and "--force" in again.stderr
    assert popsim_main("validate", "--count", 0).returncode == 2


def test_schema_accepts_what_popsim_writes(popsim) -> None:
    schema = json.loads(popsim("schema").stdout)
    card = Card(x=(-100.0, 100.0), depth=100.0)
    design = assemble(card, [BoxFold.plain("M1", card_pair(card), 20.0, 30.0, (-30.0, 30.0))])
    jsonschema.Draft202012Validator(schema).validate(json.loads(dump_design(design)))


def test_design_that_shears_fails_with_exit_code_1_and_says_why(popsim, popsim_main, tmp_path: Path) -> None:
    card = Card(x=(-100.0, 100.0), depth=100.0)
    box = BoxFold(
        "M1", card_pair(card), 20.0, BoxFold.plain("M1", card_pair(card), 20.0, 30.0, (0.0, 40.0)).tops, ()
    )
    (tmp_path / "shears.json").write_text(dump_design(assemble(card, [box])))
    done = popsim("verify", "shears.json", "--report", "verdict.json")
    assert done.returncode == 1
    assert "FAILED" in done.stdout and "stable" in done.stdout
    assert json.loads((tmp_path / "verdict.json").read_text())["passed"] is False
    again = popsim_main("verify", "shears.json", "--report", "verdict.json")
    assert again.returncode == 2 and "--force" in again.stderr
