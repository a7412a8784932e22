"""From a model to all files, with hinges held on more of their lines where no flap fits."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from popsim.layout import NoFlapError
from popsim.pipeline.deliver import Delivery, deliver
from popsim.pipeline.run import DesignRun, Progress, run_design
from popsim.pipeline.settings import RunSettings

ROUNDS = 6
"""How often a model is designed anew; each time a hinge is held on twice as much of its line."""


def complete(
    path: Path,
    settings: RunSettings,
    folder: Path,
    *,
    command: str,
    footer: Callable[[DesignRun], str],
    force: bool,
    progress: Progress = lambda stage: None,
) -> tuple[DesignRun, Delivery]:
    """Design a model and write everything; see :func:`popsim.pipeline.run.run_design` and :func:`deliver`.

    Contours may leave a hinge so little paper that no flap fits there. Then the model is designed anew with more
    paper at that hinge; the notes say so.

    Raises
    ------
    MeshError, InputError, OutputError
        As these do; a hinge may be too short for a flap even so.
    """
    while True:
        run = run_design(path, settings, progress)
        try:
            made = deliver(run, folder, command=command, footer=footer(run), force=force, progress=progress)
            return run, made
        except NoFlapError as error:
            cut = settings.patches
            if cut.share(error.patches) == 1 or len(cut.held) == ROUNDS:
                raise
            progress(f"{error.between}: holding more of their hinge, for no flap fits on less")
            settings = replace(settings, patches=replace(cut, held=(*cut.held, error.patches)))
