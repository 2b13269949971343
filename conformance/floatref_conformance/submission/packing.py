"""From a finished run to the members of its archive."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from floatref_conformance.case_files import document as case_document
from floatref_conformance.case_files import name_of
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import CaseResult, RunResult
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.runner import UNDESCRIBED, Plan
from floatref_conformance.render.report import NAME as REPORT
from floatref_conformance.render.report import as_json
from floatref_conformance.submission.agreement import SCORED, compare_results
from floatref_conformance.submission.case_collector import CaseCollector
from floatref_conformance.submission.checksums import SUMS, list_sums
from floatref_conformance.submission.document import NAME, Submission, write_json
from floatref_conformance.submission.origins import (
    describe_environment,
    describe_suite,
    hash_device,
)
from floatref_conformance.submission.rescoring import score_again
from floatref_conformance.submission.result_records import write_result
from floatref_conformance.submission.stored_answers import FOLDER, read_passes, write_passes

RESULTS = "results"
STOPPED = "when it was stopped, the device "


def describe_plan(plan: Plan, files: Iterable[Path], statement: str) -> dict[str, Any]:
    """Return what is known before the run: hashes of the device, suite and environment.

    The device is hashed before it runs: what it is then is what is judged.
    """
    return {
        "files": hash_device(plan.device, plan.spec, files),
        "statement": statement,
        "suite": describe_suite(),
        "environment": describe_environment(),
    }


def make_members(
    plan: Plan, collected: CaseCollector, known: Mapping[str, Any]
) -> dict[str, bytes]:
    """Return the members of the archive of a finished run, `SUMS` included.

    Every stored profile is scored again; SuiteError if a figure differs then.
    """
    result = collected.result
    if result is None:
        raise SuiteError("the run has no result")
    submission = describe_run(plan, result, collected, known)
    report, spec = as_json(result), str(result.device["spec"])
    members = {
        NAME: write_json(submission.document),
        REPORT: write_json(report),
        **{
            f"{RESULTS}/{id_}.json": write_json([write_result(r) for r in results])
            for id_, results in collected.results.items()
        },
        **write_cases(report["checks"], result.device_class, spec, result.edition),
    }
    for id_, decisive in collected.decisive():
        members |= _write_answers(plan, submission, id_, decisive)
    return {**members, SUMS: list_sums(members)}


def describe_run(
    plan: Plan, result: RunResult, collected: CaseCollector, known: Mapping[str, Any]
) -> Submission:
    """Return the submission of a finished run."""
    reasons = [check.reason for check in result.checks]
    stopped = next((r.partition(STOPPED)[2] for r in reasons if STOPPED in r), "")
    return Submission(
        edition=result.edition,
        seed=result.seed,
        effort=plan.effort,
        device_class=result.device_class,
        checks=tuple(check.id for check in plan.checks),
        searching=plan.searching,
        device={**result.device, "files": known["files"]},
        fault=_find_fault(result, collected),
        end_fault=stopped,
        timeout_s=plan.timeout_s,
        variables=plan.variables,
        waivers=plan.waivers,
        statement=known["statement"],
        suite=known["suite"],
        environment=known["environment"],
    )


def _find_fault(result: RunResult, collected: CaseCollector) -> str:
    """Return why the device gave no description: it is then the fault of every case."""
    if result.device["architecture"] != UNDESCRIBED.architecture:
        return ""
    faults = [case.fault for cases in collected.results.values() for case in cases]
    return next((fault for fault in faults if fault), "gives no description")


def write_cases(
    checks: Iterable[Mapping[str, Any]], device_class: DeviceClass, spec: str, edition: str
) -> dict[str, bytes]:
    """Return the simplest failing case of every check of a report.

    They are files as `conformance replay` takes them.
    """
    cases = {}
    for check in checks:
        found = check["counterexample"]
        if found is not None:
            case = Case.of(check["id"], found["parameters"])
            kept = case_document(case, device_class, spec, found["reason"], edition)
            cases[name_of(case)] = write_json(kept)
    return cases


def _write_answers(
    plan: Plan, submission: Submission, id_: str, result: CaseResult
) -> dict[str, bytes]:
    """Return the members that hold the profiles of ``result``, with the hashes of its inputs."""
    files = write_passes(result.passes)
    description = submission.describe()
    check = next(check for check in plan.checks if check.id == id_)
    case = Case.of(id_, result.parameters, result.name)
    again, inputs = score_again(
        check, case, read_passes(files, "answer"), description, plan.edition
    )
    for difference in compare_results(result, again, SCORED):
        raise SuiteError(f"{id_}, {result.name}: {difference}, scored from the stored profile")
    head = {"check": id_, "name": result.name, "parameters": dict(result.parameters)}
    content = {"case.json": write_json({**head, "inputs": inputs}), **files}
    return {f"{FOLDER}/{id_}-{case.digest}/{name}": data for name, data in content.items()}
