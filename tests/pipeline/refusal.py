"""Runs whose design is refused."""

from dataclasses import replace

from popsim.pipeline import DesignRun
from popsim.verification import verify
from popsim.verification.settings import Settings


def refused(run: DesignRun) -> DesignRun:
    """A run, judged so that nothing passes."""
    return replace(run, verdict=verify(run.design, Settings(protruding=-1.0)))
