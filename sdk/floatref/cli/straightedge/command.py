"""`floatref straightedge`: a rolling straightedge and a profilograph on a profile."""

from pathlib import Path

import click

from floatref.cli.number_option import number_option
from floatref.cli.printing import print_json
from floatref.cli.straightedge.straightedge_report import (
    Straightedge,
    parse_wheels,
    straightedge_report,
)
from floatref.cli.straightedge.straightedge_tables import print_tables
from floatref.engine.formats import profile_of
from floatref.files.sources import name_errors
from floatref.measures import Profilograph, TraceRules

EDGE, MACHINE, RULES = Straightedge(), Profilograph(), TraceRules()


@click.command("straightedge")
@click.argument("profile", type=click.Path(path_type=Path))
@number_option("--length", EDGE.length_m, "Length of the straightedge.")
@number_option("--tolerance", EDGE.tolerance_m, "Deviation in its middle that is allowed.")
@click.option(
    "--wheels",
    metavar="METRES,…",
    help="Wheels of the profilograph's frame, from its recording wheel.  [default: -3.81,3.81]",
)
@number_option(
    "--low-pass",
    MACHINE.low_pass_m,
    "Wavelength at which the profilograph's low-pass loses 3 dB, 0 for no low-pass.",
)
@number_option("--blanking-band", RULES.blanking_band_m, "Height of the blanking band.")
@number_option(
    "--bump", RULES.bump_height_m, "Height above which a bump within 7.62 m must be ground."
)
@number_option("--segment", RULES.segment_m, "Length of a segment with a profile index of its own.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def straightedge(
    profile: Path,
    length: float,
    tolerance: float,
    wheels: str | None,
    low_pass: float,
    blanking_band: float,
    bump: float,
    segment: float,
    as_json: bool,
) -> None:
    """Roll a straightedge and a profilograph along PROFILE, and print what they measure.

    PROFILE is a profile directory or a file of any format. All measured points count; each figure
    has the share of it that rests on valid points only.
    """
    edge = Straightedge(length, tolerance)
    places = MACHINE.wheels_m if wheels is None else parse_wheels(wheels)
    machine = Profilograph(places, low_pass)
    rules = TraceRules(blanking_band_m=blanking_band, bump_height_m=bump, segment_m=segment)
    read = profile_of(profile)
    with name_errors(profile):
        report = straightedge_report(read, edge, machine, rules)
    if as_json:
        print_json(report)
    else:
        print_tables(report)
