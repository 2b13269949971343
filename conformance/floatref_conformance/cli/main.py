"""Entry point of the `conformance` command."""

import click

from floatref.version import __version__
from floatref_conformance.cli.no_verdict import VerdictGroup

COMMANDS = {
    "run": ("floatref_conformance.cli.run:run", "judge a device"),
    "list": ("floatref_conformance.cli.list:list_", "list the checks and the devices"),
    "scenario": ("floatref_conformance.cli.scenario:scenario", "list the keys of a scenario file"),
    "simulate": ("floatref_conformance.cli.simulate:simulate", "write a simulated recording"),
    "sample": ("floatref_conformance.cli.sample:sample", "write data to try a command on"),
    "replay": ("floatref_conformance.cli.replay:replay", "run one kept case again"),
    "submit": (
        "floatref_conformance.cli.submissions.submit:submit",
        "judge, and pack what others can check",
    ),
    "verify": (
        "floatref_conformance.cli.submissions.verify:verify",
        "repeat what a submission rests on",
    ),
    "matrix": ("floatref_conformance.cli.matrix.command:matrix", "put reports beside each other"),
    "export": ("floatref_conformance.cli.export:export", "write the recordings of all checks"),
    "explain": ("floatref_conformance.cli.explain:explain", "explain what a check asks, and why"),
    "selftest": ("floatref_conformance.cli.selftest:selftest", "test the suite itself"),
    "certify": (
        "floatref_conformance.cli.certify.command:certify",
        "judge a profiler from recorded runs",
    ),
    "table": ("floatref_conformance.cli.table:table", "put the published tables beside ours"),
    "faults": ("floatref_conformance.cli.faults.command:faults", "put faults into drives"),
}


@click.group(cls=VerdictGroup, lazy=COMMANDS)
@click.version_option(__version__, prog_name="conformance")
def main() -> None:
    """Judge the software of an inertial profiler on simulated recordings with known truth."""
