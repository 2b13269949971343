"""`floatref pipelines`: which pipeline for these sensors, or for a recording, then all of them."""

from pathlib import Path

import click

from floatref.cli.pipelines.pipelines_report import pipelines_report, recording_report
from floatref.cli.pipelines.pipelines_tables import print_for_recording, print_for_sensors
from floatref.cli.printing import print_json, progress_bar
from floatref.errors import InputError


@click.command("pipelines")
@click.argument("recording", required=False, type=click.Path(path_type=Path))
@click.option("--adapter", metavar="NAME", help="Read RECORDING with this adapter.")
@click.option(
    "--map",
    "channel_map",
    type=click.Path(path_type=Path),
    metavar="FILE.toml",
    help="Channel map of a native file.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def pipelines(
    recording: Path | None, adapter: str | None, channel_map: Path | None, as_json: bool
) -> None:
    """Show which pipeline `auto` takes for which sensors, and list all pipelines.

    With RECORDING, a recording directory or a native file, it shows which one is taken for that,
    what the others lack, and where the vehicle stops. Nothing is processed.
    """
    if recording is None:
        if adapter is not None or channel_map is not None:
            raise InputError("--adapter and --map read a recording; give RECORDING")
        report = pipelines_report()
        print_json(report) if as_json else print_for_sensors(report)
    else:
        from floatref.mapping.sources import recording_of

        with progress_bar("Reading", as_json) as shown:
            read = recording_of(recording, adapter, channel_map, shown)
        report = recording_report(recording, read)
        print_json(report) if as_json else print_for_recording(report)
    if not as_json:
        for line in report["warnings"]:
            click.echo(f"Warning: {line}", err=True)
