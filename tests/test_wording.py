"""What is said to the maker of a pop-up stands in one place."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from popsim import wording

ROOT = Path(__file__).resolve().parent.parent / "popsim"
FILES = sorted(path for package in ("assembly", "booklet") for path in (ROOT / package).rglob("*.py"))

FEWEST = 3
"""Words that make a sentence, or part of one; names, keys and messages to developers are shorter."""

MARKUP = re.compile(r"<[^>]*>|[{};]|[\w-]+: ")
"""What is no sentence: tags, and rules of a style sheet."""


def sentences(source: str) -> Iterator[str]:
    """Literals that read like words to somebody, without docstrings."""
    tree = ast.parse(source)
    silent = {
        id(node)
        for parent in ast.walk(tree)
        if isinstance(parent, (ast.Expr, ast.JoinedStr))
        for node in ast.iter_child_nodes(parent)
        if isinstance(node, ast.Constant)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            text = " ".join(str(part.value) for part in node.values if isinstance(part, ast.Constant))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in silent:
            text = node.value
        else:
            continue
        if not MARKUP.search(text) and len(re.findall(r"(?<!\S)[A-Za-z]{2,}", text)) >= FEWEST:
            yield text


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_other_module_holds_sentences(path: Path) -> None:
    assert list(sentences(path.read_text())) == []


def test_sentences_are_found_where_there_are_some() -> None:
    """Negative control: plain ones and such with something in them, but not docstrings."""
    told = list(sentences('"""No words to anybody."""\na = "Glue it on now"\nb = f"laid from {a} above it"\n'))
    assert told == ["Glue it on now", "laid from   above it"]
    assert len(list(sentences((ROOT / "wording.py").read_text()))) > 30


def test_lists_and_numbers_read_well() -> None:
    assert wording.listed(["1"]) == "1"
    assert wording.listed(["1", "2", "3"]) == "1, 2 and 3"
    assert wording.counted(1, wording.SHEETS) == "1 sheet"
    assert wording.counted(2, wording.SHEETS) == "2 sheets"
    assert wording.sentence("fold it") == "Fold it."
