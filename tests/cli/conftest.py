"""The command as a user runs it."""

import gc
import os
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from command import run_popsim

from popsim.cli import THREADS, main

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def popsim(tmp_path: Path) -> Run:
    """Run `popsim` with arguments in an empty folder."""
    return partial(run_popsim, tmp_path)


@pytest.fixture
def popsim_main(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Run:
    """The same without another Python, which takes a second to start; what a command does not catch is raised."""

    def run(*arguments: object) -> subprocess.CompletedProcess[str]:
        words = ["popsim", *map(str, arguments)]
        with monkeypatch.context() as patch:
            patch.chdir(tmp_path)
            patch.setattr(sys, "argv", words)
            patch.setenv("COLUMNS", "120")
            patch.setenv(THREADS, os.environ.get(THREADS, "1"))
            with pytest.raises(SystemExit) as ended:
                main()
        gc.unfreeze()
        code = ended.value.code
        assert isinstance(code, int)
        return subprocess.CompletedProcess(words, code, *capfd.readouterr())

    return run
