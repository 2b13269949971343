"""A result in words, the same in the terminal and in every report."""

import shlex
from collections.abc import Mapping, Sequence
from math import isfinite, isnan
from pathlib import Path, PurePosixPath
from typing import Any

from floatref_conformance.case_files import FOLDER
from floatref_conformance.checks.verdict import CheckResult, Measurement, Outcome, RunResult
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import RESPONSE
from floatref_conformance.editions import EDITION

FAILED = (Outcome.FAIL, Outcome.ERROR)
WHERE = "this case alone, where the run was started"
"""Where a command to run a case again is to be given."""
UNJUDGED = (Outcome.SKIP, Outcome.NOT_APPLICABLE)
"""Outcomes that do not judge the device."""
INDICATION = "This is an indication, no proof."


def sensors(architecture: str, capabilities: Sequence[str]) -> str:
    """Return what a device of ``architecture`` with ``capabilities`` senses by."""
    named = ", ".join(capabilities) or "nominal sensors alone"
    return f"{named}, no height sensor" if architecture == RESPONSE else named


def margin(worst: Measurement, device_class: DeviceClass) -> float | None:
    """Return how far ``worst`` is from its limit, as a share of it; below 0 it is beyond.

    None for a value that is no number and for one that ``device_class`` does not limit.
    """
    ratio = worst.ratio(device_class)
    return 1.0 - ratio if isfinite(ratio) and device_class in worst.limits else None


def share_in_words(worst: Measurement, device_class: DeviceClass) -> str:
    """Return what share of its limit ``worst`` is, which ``device_class`` limits."""
    ratio = worst.ratio(device_class)
    return f"{100 * ratio:.3g} % of the limit" if isfinite(ratio) else "not a number"


def outcome_in_words(check: CheckResult) -> str:
    """Return the outcome; a check that a device skipped differs from one that was not run."""
    if check.outcome is Outcome.SKIP:
        return "skipped" if check.cases else "not run"
    return check.outcome.value.replace("-", " ")


def quantity(value: float, unit: str) -> str:
    """Return three significant digits and the unit, if there is one."""
    if isnan(value):
        return "not a number"
    return f"{value:.3g} {unit}".strip()


def limit_in_words(worst: Measurement, device_class: DeviceClass) -> str:
    """Return the limit that ``device_class`` sets to ``worst``."""
    return quantity(worst.limits[device_class], worst.unit)


def describe_worst(check: CheckResult, device_class: DeviceClass) -> str:
    """Return what the value of the judge's table is a value of, and in which case it was found.

    Where `why_unlimited`, the reason in its place.
    """
    worst = check.shown
    if worst is None or why_unlimited(check, device_class):
        return why_unlimited(check, device_class)
    case = f", case {check.shown_case}" if check.shown_case else ""
    return f"worst is the {worst.quantity} of track {worst.track}{case}"


def why_unlimited(check: CheckResult, device_class: DeviceClass) -> str:
    """Return why ``device_class`` limits no value of a check; empty if it limits one.

    A class may limit valid points only, and the device may flag all points as invalid.
    """
    if check.shown is None or device_class in check.shown.limits:
        return ""
    if check.flagged_m:
        return f"no value that class {device_class} limits was valid"
    return f"no value that class {device_class} limits was measured"


def describe_flagged(check: CheckResult) -> str:
    """Return how much of a profile was flagged invalid."""
    return f"up to {check.flagged_m:.1f} m of a wheel path flagged invalid"


def describe_early(check: CheckResult) -> str:
    """Return the warning about a profile that ends before its recording."""
    return f"warning: a profile ends {check.early_m:.3f} m before its recording"


def describe_false_alarms(check: CheckResult) -> str:
    """Return how many healthy recordings were refused."""
    recordings = "recording" if check.false_alarms == 1 else "recordings"
    return f"false alarm: {check.false_alarms} healthy {recordings} refused"


def not_run_lines(result: RunResult) -> list[str]:
    """Return one line per reason for which checks were left out or skipped, naming them."""
    reasons: dict[str, list[str]] = {}
    for check in (*result.checks, *result.streams_shown):
        if check.outcome is Outcome.SKIP:
            what = "Skipped by the device" if check.cases else "Not run"
            reasons.setdefault(f"{what} ({check.reason})", []).append(check.id)
    return [f"{reason}: {', '.join(ids)}" for reason, ids in reasons.items()]


def summary(result: RunResult) -> str:
    """Return how many checks passed; what was not run is never called passed."""
    judged = [c for c in result.checks if c.outcome not in UNJUDGED]
    passed = sum(c.outcome is Outcome.PASS for c in judged)
    parts = [f"{passed} of {len(judged)} checks that ran passed{_streams(result)}"]
    waived = sum(c.outcome is Outcome.WAIVED for c in judged)
    if waived:
        parts.append(f"{waived} failed and {_be(waived)} waived")
    left_out = sum(c.outcome is Outcome.SKIP for c in result.checks)
    if left_out:
        parts.append(f"{left_out} {_be(left_out)} not run and not judged")
    left_out = sum(c.outcome is Outcome.SKIP for c in result.streams_shown)
    if left_out:
        checks = "stream check" if left_out == 1 else "stream checks"
        parts.append(f"{left_out} {checks} {_be(left_out)} not run and not judged")
    if result.false_alarms:
        alarms = "false alarm" if result.false_alarms == 1 else "false alarms"
        parts.append(f"{result.false_alarms} {alarms}")
    again = sum(case["outcome"] in FAILED for case in result.replayed)
    if again:
        verb = "fails" if again == 1 else "fail"
        parts.append(f"{again} of {len(result.replayed)} kept cases still {verb}")
    return "; ".join(parts)


def _streams(result: RunResult) -> str:
    """Return how many checks of streams passed; empty if no such check judged the device."""
    judged = [c for c in result.streams if c.outcome not in UNJUDGED]
    passed = sum(c.outcome is Outcome.PASS for c in judged)
    return f" and {passed} of {len(judged)} stream checks" if judged else ""


def _be(number: int) -> str:
    return "was" if number == 1 else "were"


def verdict_line(result: RunResult) -> str:
    """Return the verdict in one line."""
    settings = f"class {result.device_class}, seed {result.seed}, effort {result.effort}"
    return f"{result.verdict}: {summary(result)} ({settings})"


def resemblance_lines(result: RunResult) -> list[str]:
    """Return which flaws a failing device resembles; empty where nobody asked."""
    found = result.resemblance
    if found is None:
        return []
    if found.note:
        return [f"Resemblance: unknown, since {found.note}"]
    if not found.flaws:
        return ["Resembles no flaw of the catalogue"]
    named = [f"{one.flaw} ({one.mutant}, {100 * one.alike:.0f} % alike)" for one in found.flaws]
    rest = f"; then {'; '.join(named[1:])}" if named[1:] else ""
    return [f"Resembles most: {named[0]}{rest}. {INDICATION}"]


def simplest(counterexample: Mapping[str, Any]) -> str:
    """Return the numbers of the simplest case that fails, as far as they are not the defaults."""
    parameters = counterexample["parameters"]
    numbers = [*parameters.get("scenario", {}).items(), *parameters.get("variation", {}).items()]
    text = ", ".join(f"{name} {in_words(value)}" for name, value in numbers)
    return f"the simplest case that fails: {text or 'all numbers as by default'}"


def in_words(value: Any) -> str:
    """Return a number of a case without needless zeros."""
    if isinstance(value, (list, tuple)):
        return ", ".join(map(in_words, value))
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def replayed_line(replayed: Mapping[str, Any]) -> str:
    """Return what a kept case came to."""
    reason = f" ({replayed['reason']})" if replayed.get("reason") else ""
    return f"Replayed {replayed['file']}: {replayed['outcome']}{reason}"


def reproduction(result: RunResult, *ids: str) -> str:
    """Return the command that runs checks ``ids`` again, or else all that failed."""
    words = ["conformance", "run", "--device", str(result.device["spec"])]
    words += ["--class", result.device_class.value, "--seed", str(result.seed)]
    if result.effort != Effort.QUICK:
        words += ["--effort", result.effort]
    if result.edition != EDITION:
        words += ["--edition", result.edition]
    for id_ in ids or [c.id for c in (*result.checks, *result.streams) if c.outcome in FAILED]:
        words += ["--check", id_]
    return shlex.join(words + _device_options(result))


def replay_command(file: str, result: RunResult) -> str:
    """Return the command that runs the case in ``file`` again, where the run was started.

    There, and not in the report's folder, a SPEC means what it meant in the run.
    """
    path = (result.report or Path()) / FOLDER / PurePosixPath(file).name
    words = ["conformance", "replay", path.as_posix(), "--device", str(result.device["spec"])]
    return shlex.join([*words, "--class", result.device_class.value, *_device_options(result)])


def _device_options(result: RunResult) -> list[str]:
    limit = result.timeout_s
    words = [] if limit is None else ["--device-timeout", f"{limit:.12g}"]
    return words + [word for name in result.variables for word in ("--env", name)]
