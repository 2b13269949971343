"""Checks in several processes: the report of one process, and devices that cannot be run so."""

import json
import signal
import subprocess
import sys
import time
from dataclasses import replace
from multiprocessing.reduction import ForkingPickler
from pickle import loads
from types import MappingProxyType

import pytest

from floatref.errors import InputError
from floatref_conformance.case_files import read_cases
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.cli.options import writers_into
from floatref_conformance.devices.recorded import RecordedDevice
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.in_processes import Part, refuse_processes, run_in_processes
from floatref_conformance.judge.runner import Plan
from floatref_conformance.plugins import load_registry

SPEC = "builtin:temporal-basic"


def plan_of(*ids, **settings):
    registry = load_registry()
    checks, left_out = registry.select(ids)
    return Plan(SPEC, registry.device(SPEC), checks, left_out, ahead=True, **settings)


def reported(plan, processes, folder):
    """Return the reports of ``plan`` by name, without times, and the events of the run."""
    events = []
    writers = writers_into(folder)

    def emit(event):
        events.append(event)
        for writer in writers:
            writer.handle(event)

    run_in_processes(replace(plan, report=folder), emit, processes)
    files = [folder / "report.json", *sorted((folder / "cases").iterdir())]
    return {file.name: file.read_bytes() for file in files}, events


@pytest.mark.slow
def test_two_processes_write_the_reports_of_one(tmp_path):
    plan = plan_of("bounce", "constant-speed", "stop")
    one, _ = reported(plan, 1, tmp_path / "one")
    two, events = reported(plan, 2, tmp_path / "two")
    assert one == two
    assert any(name.startswith("stop-") for name in one)
    checks = [e.result.id for e in events if type(e).__name__ == "CheckFinished"]
    assert checks == ["bounce", "constant-speed", "stop"]
    stored = read_cases(tmp_path / "two", plan.edition.name)
    again = [
        reported(replace(plan_of("bounce", "stop"), kept=tuple(stored)), n, tmp_path / str(n))[0]
        for n in (1, 2)
    ]
    assert again[0] == again[1]
    assert len(json.loads(again[0]["report.json"])["replayed"]) == 1


def test_a_part_is_the_plan_of_its_check_in_another_process():
    plan = plan_of(
        "bounce",
        "stop",
        device_class=DeviceClass.ADEQUATE,
        seed=7,
        effort=Effort.CERTIFICATION,
        searching=False,
        waivers={"stop": "known"},
        edition=find_edition("2026.1"),
    )
    part = loads(ForkingPickler.dumps(Part.of(plan, "stop"))).plan
    (check,) = part.checks
    assert (check.id, part.left_out, part.ahead) == ("stop", (), True)
    assert part.edition is plan.edition
    for name in ("spec", "device", "device_class", "seed", "effort", "searching", "waivers"):
        assert getattr(part, name) == getattr(plan, name), name


def test_a_view_of_a_mapping_comes_back_as_one():
    view = MappingProxyType({"a": (1, 2)})
    back = loads(ForkingPickler.dumps(view))
    assert (type(back), back) == (MappingProxyType, view)


@pytest.mark.parametrize("spec", ["exec:cat", "python:os:getcwd", "mutant:wrong-sign"])
def test_a_device_that_may_not_run_twice_at_once_is_refused(plan, fake_device, spec):
    made = replace(plan(fake_device()), spec=spec)
    refuse_processes(made, 1)
    with pytest.raises(InputError, match=f"--jobs 2: device {spec} may not run several times"):
        refuse_processes(made, 2)


def test_pipelines_and_folders_of_profiles_may(tmp_path):
    for device in (load_registry().device(SPEC), RecordedDevice(tmp_path, {})):
        refuse_processes(replace(plan_of("stop"), device=device), 8)


def test_no_other_kind_of_device_may():
    kinds = load_registry().kinds
    mutants = [kinds["mutant"].make(entry.name) for entry in kinds["mutant"].entries()]
    programs = [kinds["exec"].make(f"{sys.executable} -V")]
    assert not [d for d in (*mutants, *programs) if getattr(d, "concurrent", False)]


@pytest.mark.slow
@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGINT])
def test_an_interrupted_run_ends_at_once_with_its_processes(sent, tmp_path):
    words = ["run", "--device", SPEC, "--jobs", "2", "--effort", "certification"]
    command = [sys.executable, "-m", "floatref_conformance", *words]
    done = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert done.stdout.readline().startswith("device ")
    assert done.stdout.readline().startswith("quiescent")
    time.sleep(3.0)
    done.send_signal(sent)
    _, errors = done.communicate(timeout=60)
    assert (done.returncode, errors) == (130, "Interrupted: no verdict\n")
