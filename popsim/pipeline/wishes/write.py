"""The wishes file that a run leaves behind: what it chose, to be edited and run again."""

import json
from collections.abc import Sequence
from typing import Any

from popsim.design import Source
from popsim.mechanisms import Mechanism
from popsim.mechanisms.restore import essential
from popsim.mesh.alignment import Side
from popsim.pipeline.wishes.model import FORMAT, VERSION

HEAD = """\
# What popsim chose. Edit it, then run:
#   {again}
# keep: mechanisms that stay exactly as they are here. Change a number; delete an entry and all that stands on it.
# add: true lets popsim add mechanisms to what is kept.
# forbid: types of mechanisms, for example [v-fold-1, step-fold].
# keep_out: regions that stay free, for example [{{x: [-20, 10], z: [40, 90]}}], mm in the open card:
#   x along the fold, y towards the ground page, z up.
# pin: types for regions, for example [{{type: tent-fold, region: {{x: [0, 50]}}}}].
"""


def wishes_text(
    mechanisms: Sequence[Mechanism],
    *,
    size: float,
    fold: Side,
    most_patches: int,
    source: Source,
    command: str,
) -> str:
    """Return the file that keeps all `mechanisms` and adds nothing: the same run again.

    Parameters
    ----------
    mechanisms:
        Bases before what stands on them.
    size:
        Longest side of the model, mm.
    fold:
        Horizontal side of the model along which the fold runs.
    most_patches, source, command:
        Of the run.
    """
    import yaml

    fields: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "source": source.model_dump(mode="json"),
        "size": f"{size!r}mm",
        "fold": fold,
        "most_patches": most_patches,
        "add": False,
        "forbid": [],
        "keep_out": [],
        "pin": [],
        "keep": [_entry(mechanism) for mechanism in mechanisms],
    }
    body: str = yaml.safe_dump(fields, sort_keys=False, default_flow_style=None, width=110, allow_unicode=True)
    again = command if " --wishes " in command else f"{command} --wishes wishes.yaml"
    return HEAD.format(again=again) + body


def _entry(mechanism: Mechanism) -> dict[str, Any]:
    return {
        "id": mechanism.id,
        "type": mechanism.type,
        "base": list(mechanism.pair.patches),
        "parameters": json.loads(json.dumps(essential(mechanism))),
    }
