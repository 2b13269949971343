"""`floatref adapters`: the adapters and the formats of profile files."""

import click

from floatref.cli.printing import print_json, print_table
from floatref.engine.plugins import plugins


@click.command("adapters")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def adapters(as_json: bool) -> None:
    """List the adapters, which read native formats, and the formats of profiles and recordings."""
    known, formats = plugins().adapters().values(), plugins().profile_formats().values()
    written = plugins().recording_formats().values()
    if as_json:
        items = [{"name": adapter.name, "summary": adapter.summary} for adapter in known]
        kinds, recordings = (
            [{"name": f.name, "suffix": f.suffix, "summary": f.summary} for f in found]
            for found in (formats, written)
        )
        lists = {"adapters": items, "formats": kinds, "recording_formats": recordings}
        print_json({**lists, "warnings": plugins().reports})
        return
    rows = [[adapter.name, adapter.summary] for adapter in known]
    print_table("Adapters", ("adapter", "what it reads"), rows, numbers=False)
    for title, found in (("Profile formats", formats), ("Recording formats", written)):
        rows = [[f.name, f.suffix or "–", f.summary] for f in found]
        print_table(title, ("format", "suffix", "what it is"), rows, numbers=False)
    for line in plugins().reports:
        click.echo(f"Warning: {line}", err=True)
