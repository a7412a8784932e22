"""Whole processes, as a user waits for them."""

import subprocess
import sys
from pathlib import Path

import pytest
from boxes import row_of_boxes
from pytest_benchmark.fixture import BenchmarkFixture

from popsim.design import dump_design


def run(*words: object) -> None:
    subprocess.run([sys.executable, "-m", "popsim", *map(str, words)], capture_output=True, check=True)


@pytest.mark.benchmark(group="whole processes")
@pytest.mark.parametrize("patches", [2, 12, 40])
def test_verify(patches: int, tmp_path: Path, benchmark: BenchmarkFixture) -> None:
    path = tmp_path / "design.json"
    path.write_text(dump_design(row_of_boxes(patches)))
    benchmark.pedantic(run, ("verify", path), rounds=3, warmup_rounds=1)


@pytest.mark.benchmark(group="whole processes")
def test_help(benchmark: BenchmarkFixture) -> None:
    benchmark.pedantic(run, ("--help",), rounds=3, warmup_rounds=1)
