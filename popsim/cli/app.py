"""All commands. Their bodies import what they need, so that --help is instant."""

import typer

from popsim import __version__
from popsim.cli.calibration import calibration
from popsim.cli.design import design
from popsim.cli.export import export
from popsim.cli.gallery import gallery
from popsim.cli.render import render
from popsim.cli.schema import schema
from popsim.cli.validate import validate
from popsim.cli.verify import verify

app = typer.Typer(
    name="popsim",
    help="Turn a 3D model into a paper pop-up that provably folds.",
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    add_completion=False,
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"popsim {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: bool = typer.Option(False, "--version", callback=_version, is_eager=True, help="Print the version."),
) -> None:
    pass


for command in (design, verify, validate, export, calibration, render, gallery, schema):
    app.command()(command)
