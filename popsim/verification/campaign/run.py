"""Running a campaign on several cores."""

from collections.abc import Callable, Iterator
from pathlib import Path

from popsim.errors import InputError
from popsim.files import write_text
from popsim.verification.campaign.campaign import Campaign, file_name
from popsim.verification.campaign.plan import Task, plan
from popsim.verification.campaign.trial import Outcome, try_task
from popsim.verification.settings import Settings

BATCH = 4
"""Designs that travel together to a worker: more would make the progress jumpy."""

DEFAULT = Settings(angles=45, first_contact=180.0)
"""Every fourth of the angles at which one design is verified, and no finer search for where contacts begin."""


def run_campaign(
    count: int,
    seed: int = 0,
    jobs: int = -1,
    *,
    folder: Path | None = None,
    progress: Callable[[Outcome], None] | None = None,
    settings: Settings = DEFAULT,
) -> Campaign:
    """Draw `count` designs, examine and verify each, and sum up.

    Parameters
    ----------
    count, seed:
        Which designs; the same numbers give the same campaign on any number of jobs.
    jobs:
        Processes; -1 takes one for each core.
    folder:
        Where designs with disagreements are written as soon as they are found; None writes none.
    progress:
        Called with each outcome, in order.
    settings:
        Tolerances of the verification.

    Raises
    ------
    InputError
        There is nothing to do, or no process to do it.
    OutputError
        A design cannot be written.
    """
    if count < 1 or seed < 0 or jobs == 0:
        raise InputError(f"a campaign needs designs, a seed from 0 and jobs, not {count}, {seed} and {jobs}")
    outcomes = []
    for outcome in _outcomes(list(plan(count, seed)), jobs, settings):
        outcomes.append(outcome)
        name = file_name(outcome)
        if folder is not None and name is not None and outcome.design is not None:
            write_text(folder / name, outcome.design, force=True)
        if progress is not None:
            progress(outcome)
    return Campaign(seed, tuple(outcomes))


def _outcomes(tasks: list[Task], jobs: int, settings: Settings) -> Iterator[Outcome]:
    """Outcomes in the order of the tasks."""
    if jobs == 1 or len(tasks) <= BATCH:
        yield from (try_task(task, settings) for task in tasks)
        return
    from joblib import Parallel, delayed

    parallel = Parallel(n_jobs=jobs, batch_size=BATCH, return_as="generator")
    yield from parallel(delayed(try_task)(task, settings) for task in tasks)
