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
from floatref_conformance.resemblance.probe_answers import ProbesTooLong, ask_probes

REPORT, PROBES = "report", "probes"
"""What shows a flaw: the faults in the report, or the probes."""
NO_ANSWERS = "only recorded profiles are there, and no device to ask"
NO_PROFILES = "the device delivered no profile of any probe"
INTERRUPTED = "the probes were interrupted"
NOT_COMPARED = "not compared: "
"""How a note begins that says what went wrong here."""
LONGEST_S = 120.0
"""Time in s for all probes together: no probe begins later, and the last is given the rest."""
TOO_LONG = f"the probes took longer than {LONGEST_S:g} s"
FAILED = (Outcome.FAIL, Outcome.ERROR)


def add_resemblance(result: RunResult, device: Device) -> RunResult:
    """Return ``result`` with the flaws that ``device`` resembles, if it failed.

    A device that is stopped is started for the probes, and stopped again. What goes wrong here
    is a note in the result, and so is Ctrl-C: the verdict does not depend on it.
    """
    if result.verdict is not Verdict.FAIL:
        return result
    try:
        found = name_flaws(result, device)
    except KeyboardInterrupt:
        # The run is over: its reports are worth more than the flaw that it resembles.
        found = _leave_out(INTERRUPTED)
    except (Exception, SystemExit) as error:
        text = " ".join(str(error).split())
        found = _leave_out(f"{NOT_COMPARED}{type(error).__name__}: {text}")
    return replace(result, resemblance=found)


def _leave_out(note: str) -> Resemblance:
    """Return that no flaw was looked for to the end, and why."""
    return Resemblance(PROBES, least=LEAST, note=note)


def is_left_out(note: str) -> bool:
    """Return whether ``note`` says that the probes were not finished, or not compared."""
    return note in (INTERRUPTED, TOO_LONG) or note.startswith(NOT_COMPARED)


def was_interrupted(result: RunResult) -> bool:
    """Return whether Ctrl-C ended the probes of ``result``, whose verdict was known then."""
    return result.resemblance is not None and result.resemblance.note == INTERRUPTED


def name_flaws(result: RunResult, device: Device) -> Resemblance:
    """Return the flaws that ``device`` resembles by its ``result``, or else by the probes."""
    checks = [Judged.of(check) for check in result.checks]
    streams = [Judged.of(check) for check in result.streams]
    shown = name_by_report(checks, streams)
    if shown:
        return Resemblance(REPORT, shown, 1.0)
    return name_by_probes(device, describe_again(result))


def name_by_probes(device: Device, description: Description) -> Resemblance:
    """Return the flaws that ``device`` resembles by its answers on the probes; it is closed."""
    if not getattr(device, "searchable", True):
        return _leave_out(NO_ANSWERS)
    try:
        features = measure_features(ask_probes(device, description, longest_s=LONGEST_S))
    except ProbesTooLong:
        # Features of some probes would depend on how fast the machine is.
        return _leave_out(TOO_LONG)
    finally:
        close(device)
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
    """Return the flaws of the catalogue near to ``features``; a note if there is no profile."""
    if not any(name.endswith(": length") for name in features):
        return Resemblance(PROBES, least=LEAST, features=features, note=NO_PROFILES)
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
