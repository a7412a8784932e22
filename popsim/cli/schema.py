"""`popsim schema`."""

import typer


def schema() -> None:
    """Print the JSON Schema of design.json."""
    import json

    from popsim.design.file import design_schema

    typer.echo(json.dumps(design_schema(), indent=2))
