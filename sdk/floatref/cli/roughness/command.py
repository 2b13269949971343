"""`floatref roughness`: localized roughness, MRI, HRI, Ride Number, wavebands and sections."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from floatref.cli.number_option import number_option
from floatref.cli.printing import print_json
from floatref.cli.recordings.segment_places import layer_of, layer_options, write_profile_layer
from floatref.cli.roughness.roughness_report import RoughnessLimits, roughness_report
from floatref.cli.roughness.roughness_tables import print_tables
from floatref.engine.formats import profile_of
from floatref.files.sources import name_errors
from floatref.measures.ride.segment_measures import RideLimits

DEFAULT = RoughnessLimits()


@click.command("roughness")
@click.argument("profile", type=click.Path(path_type=Path))
@click.option(
    "--tracks",
    nargs=2,
    metavar="LEFT RIGHT",
    help="The wheel paths of the lane, where PROFILE has more than two.",
)
@number_option(
    "--threshold",
    DEFAULT.threshold_m_per_km,
    "Continuous IRI over 7.62 m above which roughness is localized, in m/km.",
    name="threshold_m_per_km",
    unit="M_PER_KM",
)
@number_option(
    "--deviation",
    DEFAULT.deviation_m,
    "Deviation from the moving average beyond which there is a bump or a dip.",
    name="deviation_m",
)
@number_option("--section", DEFAULT.section_m, "Length of a section.", name="section_m")
@click.option(
    "--band",
    "bands",
    type=float,
    nargs=2,
    multiple=True,
    metavar="LONG SHORT",
    help="Longest and shortest wavelength of a waveband in m; can be repeated.",
)
@layer_options
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def roughness(
    profile: Path,
    tracks: tuple[str, str] | None,
    threshold_m_per_km: float,
    deviation_m: float,
    section_m: float,
    bands: tuple[tuple[float, float], ...],
    as_json: bool,
    **layer_given: Any,
) -> None:
    """Print what a road is paid by, of PROFILE: a profile directory or a file of any format.

    Localized roughness by continuous IRI of every wheel path, MRI, HRI, Ride Number, bumps and dips
    of the lane, wavebands, and sections of 0.1 mile. All measured points count; each figure has the
    share of valid points that it rests on.
    """
    limits = RoughnessLimits.of(threshold_m_per_km, deviation_m, section_m, bands)
    layer = layer_of(**layer_given)
    read = profile_of(profile)
    with name_errors(profile):
        report = roughness_report(read, limits, tracks)
    if layer is not None:
        lane = replace(read, tracks=tuple(map(read.track, tracks))) if tracks else read
        ride = RideLimits(limits.threshold_m_per_km, limits.deviation_m)
        write_profile_layer(lane, profile.name, section_m, layer, ride)
    if as_json:
        print_json(report)
    else:
        print_tables(report)
