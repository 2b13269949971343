"""`floatref pipelines` and `floatref adapters`: what is there to choose from."""

import click

from floatref.architectures.plugins import plugins
from floatref.cli.printing import print_json, print_table


@click.command("pipelines")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def pipelines(as_json: bool) -> None:
    """List the pipelines: their architecture, what they do, and their settings."""
    known = plugins().pipelines().values()
    if as_json:
        items = [
            {
                "name": pipeline.name,
                "architecture": pipeline.architecture,
                "summary": pipeline.summary,
                "settings": dict(pipeline.settings),
            }
            for pipeline in known
        ]
        print_json({"pipelines": items, "warnings": plugins().reports})
        return
    rows = [[pipeline.name, pipeline.architecture, pipeline.summary] for pipeline in known]
    print_table("Pipelines", ("pipeline", "architecture", "what it does"), rows, numbers=False)
    _warn()


@click.command("adapters")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def adapters(as_json: bool) -> None:
    """List the adapters: the native formats that can be read."""
    known = plugins().adapters().values()
    if as_json:
        items = [{"name": adapter.name, "summary": adapter.summary} for adapter in known]
        print_json({"adapters": items, "warnings": plugins().reports})
        return
    rows = [[adapter.name, adapter.summary] for adapter in known]
    print_table("Adapters", ("adapter", "what it reads"), rows, numbers=False)
    _warn()


def _warn() -> None:
    for line in plugins().reports:
        click.echo(f"Warning: {line}", err=True)
