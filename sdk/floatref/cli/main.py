"""Entry point of the `floatref` command."""

import click

from floatref.cli.lazy import LazyGroup
from floatref.version import __version__

COMMANDS = {
    "process": ("floatref.cli.process:process", "turn a recording into a road profile"),
    "iri": ("floatref.cli.iri:iri", "IRI of a profile, whole and by segment"),
    "roughness": (
        "floatref.cli.roughness.command:roughness",
        "MRI, HRI, Ride Number, localized roughness, sections",
    ),
    "straightedge": (
        "floatref.cli.straightedge.command:straightedge",
        "a straightedge and a profilograph on a profile",
    ),
    "compare": ("floatref.cli.compare:compare", "agreement of a profile with a reference"),
    "view": ("floatref.cli.look.view:view", "a page for the browser: zoom, table, map"),
    "plot": ("floatref.cli.look.plot:plot", "a picture of a profile or of raw channels"),
    "convert": (
        "floatref.cli.convert:convert",
        "write a profile or a recording in another format",
    ),
    "pipelines": (
        "floatref.cli.pipelines.command:pipelines",
        "which pipeline for which sensors, and all of them",
    ),
    "adapters": ("floatref.cli.listings:adapters", "list the adapters and the profile formats"),
    "channels": (
        "floatref.cli.channels:channels",
        "list the content of a native file, draft its map",
    ),
    "allan": (
        "floatref.cli.allan.command:allan",
        "noise of sensors at rest, for the Kalman pipelines",
    ),
    "tune": (
        "floatref.cli.tune.command:tune",
        "noise settings of a Kalman pipeline, from known runs",
    ),
    "batch": ("floatref.cli.batch.command:batch", "process many recordings on a cluster"),
    "live": ("floatref.cli.live.command:live", "profiles while the vehicle drives"),
    "warm": ("floatref.cli.warm.command:warm", "compile now what pipelines would compile later"),
    "vehicle": ("floatref.cli.vehicle:vehicle", "settings of a vehicle, from its runs"),
}


@click.group(cls=LazyGroup, lazy=COMMANDS)
@click.version_option(__version__, prog_name="floatref")
def main() -> None:
    """Turn the sensor streams of an inertial profiler into road profiles."""
