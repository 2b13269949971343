"""Name the flaw that a failing device resembles most: by its faults, or by the probes."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from floatref_conformance.checks.likeness import Likeness, Resemblance
from floatref_conformance.checks.verdict import Outcome, RunResult, Verdict
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.judge.exercise import close
from floatref_conformance.resemblance.catalogue import find_nearest
from floatref_conformance.resemblance.comparing import LEAST, MOST_FLAWS
from floatref_conformance.resemblance.fault_reasons import (
    Judged,
    name_protocol_flaws,
    name_stream_flaws,
)
from floatref_conformance.resemblance.features import Features, measure_features
from floatref_conformance.resemblance.probe_answers import ask_probes

REPORT, PROBES = "report", "probes"
"""What shows a flaw: the faults in the report, or the probes."""
NO_ANSWERS = "only recorded profiles are there, and no device to ask"
NO_PROFILES = "the device delivered no profile of any probe"
FAILED = (Outcome.FAIL, Outcome.ERROR)


def add_resemblance(result: RunResult, device: Device) -> RunResult:
    """Return ``result`` with the flaws that ``device`` resembles, if it failed.

    A device that is stopped is started for the probes, and stopped again. What goes wrong here
    is a note in the result: the verdict does not depend on it.
    """
    if result.verdict is not Verdict.FAIL:
        return result
    try:
        found = name_flaws(result, device)
    except (Exception, SystemExit) as error:
        text = " ".join(str(error).split())
        found = Resemblance(PROBES, note=f"not compared: {type(error).__name__}: {text}")
    return replace(result, resemblance=found)


def name_flaws(result: RunResult, device: Device) -> Resemblance:
    """Return the flaws that ``device`` resembles by its ``result``, or else by the probes."""
    checks = [Judged.of(check) for check in result.checks]
    streams = [Judged.of(check) for check in result.streams]
    shown = name_by_report(checks, streams)
    if shown:
        return Resemblance(REPORT, shown, 1.0)
    if not getattr(device, "searchable", True):
        return Resemblance(PROBES, least=LEAST, note=NO_ANSWERS)
    description = describe_again(result)
    try:
        features = measure_features(ask_probes(device, description))
    finally:
        close(device)
    if not any(name.endswith(": length") for name in features):
        return Resemblance(PROBES, least=LEAST, features=features, note=NO_PROFILES)
    return name_by_features(features, description)


def name_by_report(checks: Iterable[Judged], streams: Sequence[Judged]) -> tuple[Likeness, ...]:
    """Return the flaws that faults of a run show; empty where only probes can show one.

    A fault of the protocol hides all else. Where only streams are wrong, probes, which are whole
    recordings, show nothing.
    """
    known = list(checks)
    flaws = name_protocol_flaws(known)
    if not flaws and not any(check.outcome in FAILED for check in known):
        flaws = name_stream_flaws(streams)
    return flaws[:MOST_FLAWS]


def name_by_features(features: Features, description: Description) -> Resemblance:
    """Return the flaws of the catalogue that are near to ``features``."""
    return Resemblance(PROBES, find_nearest(features, description), LEAST, features)


def describe_again(result: RunResult) -> Description:
    """Return the description of the device of ``result``."""
    device = result.device
    return Description(
        str(device["name"]),
        str(device["version"]),
        str(device["architecture"]),
        tuple(device["capabilities"]),
    )
