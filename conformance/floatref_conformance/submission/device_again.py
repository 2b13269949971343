"""The device of an archive run again, where it is at hand."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import CaseResult
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.exercise import close, describe
from floatref_conformance.render.report import NAME as REPORT
from floatref_conformance.resemblance.reviewing import probe_again
from floatref_conformance.submission.agreement import REMADE, compare_results
from floatref_conformance.submission.document import NAME, read_json
from floatref_conformance.submission.origins import hash_device
from floatref_conformance.submission.rejudging import Repetition
from floatref_conformance.submission.rescoring import judge_on
from floatref_conformance.submission.stored_answers import refuse_without

HARMLESS = ("builtin", "mutant")
"""Kinds of devices that run without being asked for: their code is in this checkout."""


@dataclass(frozen=True)
class GivenDevice:
    """A device that a verification runs again.

    Attributes:
        spec: the SPEC by which the user, or the archive, names it.
        device: the device.
        files: further files that were hashed with it.
    """

    spec: str
    device: Device
    files: tuple[Path, ...] = ()


def repeat_device(repetition: Repetition, given: GivenDevice | None, every_case: bool) -> None:
    """Run the device again, the one ``given`` or, of a harmless kind, the one of the archive.

    What the user gives has to be the device of the archive; our own pipelines may have changed.
    """
    verification, spec = repetition.verification, repetition.submission.device["spec"]
    if given is None and spec.partition(":")[0] not in HARMLESS:
        verification.not_repeated.append("the device: give it with --device SPEC to run it again")
        return
    chosen = given or GivenDevice(spec, repetition.registry.device(spec))
    try:
        here = hash_device(chosen.device, chosen.spec, chosen.files)
        others = list_other_files(repetition.submission.device["files"], here)
        if given is None and others:
            verification.not_repeated.append(f"the device: {others[0]}")
            return
        for other in others:
            verification.contradict(f"{NAME}: device.files", other)
        _run_again(repetition, chosen, every_case)
    finally:
        fault = close(chosen.device)
    if fault and fault != repetition.submission.end_fault:
        verification.contradict("device", f"when it was stopped, it {fault}")


def _run_again(repetition: Repetition, chosen: GivenDevice, every_case: bool) -> None:
    verification, submission = repetition.verification, repetition.submission
    try:
        description = describe(chosen.device)
    except DeviceError as fault:
        if str(fault) != submission.fault:
            verification.contradict("device", str(fault))
        return
    if description != submission.describe():
        verification.contradict("device", "describes itself in another way than in the archive")
    cases = _choose(repetition, every_case)
    for case, before in cases:
        for difference in _judge_again(repetition, chosen.device, description, case, before):
            verification.contradict(f"device: {case.check}, {case.name}", difference)
    what = f"{len(cases)} cases on the device {chosen.spec}"
    (verification.repeated if cases else verification.not_repeated).append(what)
    _probe_again(repetition, chosen.device, description)


def _probe_again(repetition: Repetition, device: Device, description: Description) -> None:
    """Give ``device`` the probes again, if the report says what it resembles, or why not."""
    verification = repetition.verification
    report = read_json(refuse_without(repetition.members, REPORT), REPORT)
    found = probe_again(report, device, description) if isinstance(report, dict) else None
    if found is None:
        return
    for difference in found.differences:
        verification.contradict("device: probes", difference)
    if found.missing:
        verification.not_repeated.append(f"the probes on the device: {found.missing}")
    else:
        verification.repeated.append("the probes on the device")


def _judge_again(
    repetition: Repetition,
    device: Device,
    description: Description,
    case: Case,
    before: CaseResult,
) -> list[str]:
    check = repetition.registry.check(case.check)
    edition = find_edition(repetition.submission.edition)
    result = judge_on(device, check, case, description, edition)
    return list(compare_results(before, result, REMADE))


def _choose(repetition: Repetition, every_case: bool) -> list[tuple[Case, CaseResult]]:
    """Return the cases that the device gets again, in the order of the run, with their results."""
    decisive = repetition.decisive
    pairs = [
        (Case.of(id_, result.parameters, result.name), result)
        for id_, results in repetition.results.items()
        for result in results
    ]
    return [p for p in pairs if every_case or (p[0].check, p[0].digest) in decisive]


def list_other_files(stated: Mapping[str, str], here: Mapping[str, str]) -> list[str]:
    """Return what differs between two hashes of a device; files of one alone are others, too."""
    return [
        f"{name} is another one here than the SHA-256 in the archive"
        for name in sorted(stated.keys() | here.keys())
        if stated.get(name) != here.get(name)
    ]
