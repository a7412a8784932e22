"""`popsim` as a process of its own."""

import os
import subprocess
import sys
from pathlib import Path


def run_popsim(folder: Path, *arguments: object) -> subprocess.CompletedProcess[str]:
    """Run it with arguments in a folder."""
    words = [sys.executable, "-m", "popsim", *map(str, arguments)]
    environment = {**os.environ, "COLUMNS": "120"}
    return subprocess.run(
        words, cwd=folder, env=environment, capture_output=True, text=True, timeout=240, check=False
    )
