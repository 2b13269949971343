"""`conformance replay`: run one kept case again."""

from pathlib import Path

import click
from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

from floatref.errors import InputError
from floatref_conformance.case_files import KeptCase, read_case
from floatref_conformance.checks.verdict import CaseResult, Measurement, Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli.options import class_of, env_option, limit_time, pass_variables
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.exercise import close_on_error
from floatref_conformance.judge.replaying import replay as replayed
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.terminal import PLAIN_WIDTH, PipedConsole


@click.command()
@click.argument("case", type=click.Path(path_type=Path))
@click.option("--device", "spec", metavar="SPEC", required=True, help="Device to judge.")
@click.option(
    "--class",
    "device_class",
    type=click.Choice([c.value for c in DeviceClass]),
    help="Class whose limits decide.  [default: the one in the case]",
)
@click.option(
    "--device-timeout",
    metavar="SECONDS",
    type=click.FloatRange(min=0, min_open=True),
    help="Time for the recording.  [default: 60 s and twice its length]",
)
@env_option
@click.pass_context
def replay(
    context: click.Context,
    case: Path,
    spec: str,
    device_class: str | None,
    device_timeout: float | None,
    variables: tuple[str, ...],
) -> None:
    """Run the case that CASE keeps, a file of a report's `cases` folder.

    Exit code 0: the device keeps every limit; 1: it does not; 2: wrong usage, or a case whose
    numbers make no sense; 3: the suite itself is at fault; 4: the device skipped the case.
    """
    kept = read_case(case)
    if kept.refused:
        raise InputError(f"{case}: {kept.refused}")
    registry = load_registry(kept.edition)
    check = registry.check(kept.case.check)
    device = registry.device(spec)
    with close_on_error(device):
        limit_time(device, device_timeout)
        pass_variables(device, variables)
        decisive = kept.device_class if device_class is None else class_of(device, device_class)
    try:
        result = replayed(device, check, kept.case, find_edition(kept.edition))
    except InputError as error:
        raise InputError(f"{case}: {error}") from error
    verdict = _verdict(result, decisive)
    _show(kept, result, decisive)
    click.echo(f"{verdict}: {_reason(result, decisive)} (class {decisive}, device {spec})")
    context.exit(verdict.exit_code)


def _verdict(result: CaseResult, device_class: DeviceClass) -> Verdict:
    if result.skipped is not None:
        return Verdict.INCOMPLETE
    return Verdict.PASS if result.ratio(device_class) <= 1.0 else Verdict.FAIL


def _reason(result: CaseResult, device_class: DeviceClass) -> str:
    from floatref_conformance.judge.judging import describe_failure

    return result.skipped or describe_failure(result, device_class) or "every limit is kept"


def _show(kept: KeptCase, result: CaseResult, device_class: DeviceClass) -> None:
    """Print the numbers of the case and all that was measured."""
    console = PipedConsole(emoji=False)
    if not console.is_terminal:
        console.width = max(console.width, PLAIN_WIDTH)
    numbers = {**kept.case.parameters["scenario"], **kept.case.parameters["variation"]}
    text = ", ".join(f"{name} {value}" for name, value in numbers.items())
    console.print(f"{kept.case.check}: {text}", markup=False, highlight=False, soft_wrap=True)
    table = Table("quantity", "track", "value", "limit", "", box=SIMPLE_HEAD, pad_edge=False)
    for measured in result.measurements:
        table.add_row(*map(Text, _cells(measured, device_class)))
    if result.measurements:
        console.print(table)


def _cells(measured: Measurement, device_class: DeviceClass) -> tuple[str, ...]:
    limit = measured.limits.get(device_class)
    return (
        measured.quantity,
        measured.track,
        f"{measured.value:.4g} {measured.unit}",
        "no limit" if limit is None else f"{limit:.4g} {measured.unit}",
        "" if measured.within(device_class) else "fails",
    )
