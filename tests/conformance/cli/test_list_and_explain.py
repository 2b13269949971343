"""`conformance list` and `explain`: what there is, and what each check asks."""

import json
import re
from dataclasses import replace

import pytest
from click.testing import CliRunner

from floatref_conformance import EDITION
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.cli.main import main
from floatref_conformance.devices.interface import DeviceEntry
from floatref_conformance.plugins import load_registry


def test_list_names_checks_built_and_not_and_devices_with_what_they_must_fail(call):
    listing = json.loads(call("list", "--json").stdout)
    checks = {c["id"]: c for c in listing["checks"]}
    assert listing["edition"] == EDITION
    assert checks["toy"]["built"]
    assert checks["toy"]["clause"] == "Toy 1.2"
    assert checks["needy"]["needs"] == ["gnss"]
    assert set(checks) == {"toy", "second", "skewed", "needy", *IDS}
    assert not any(checks[id_]["built"] for id_ in IDS)
    assert listing["devices"][1] == {"spec": "fake:bad", "summary": "toy", "fails": ["toy"]}
    words = call("list").stdout
    assert "stop" in words
    assert "not built yet" in words
    assert "fake:bad" in words


@pytest.mark.parametrize("columns", [None, 60, 200])
def test_the_list_is_aligned_and_fits_the_width(monkeypatch, columns):
    if columns:
        monkeypatch.setenv("COLUMNS", str(columns))
    else:
        monkeypatch.delenv("COLUMNS", raising=False)
    sections = CliRunner().invoke(main, ["list"]).stdout.split("\n\n")
    assert [section.partition("\n")[0] for section in sections] == [
        "Checks",
        "Devices, builtin",
        "Devices, mutant",
    ]
    for section in sections:
        lines = section.rstrip("\n").split("\n")[1:]
        (indent,) = {re.match(r"(  \S+ +| +)\S", line).end() - 1 for line in lines}
        assert max(map(len, lines)) <= max(columns or 100, indent + 30)
        assert not any(line.endswith((" ", "-")) for line in lines)


def test_the_list_names_the_shorter_of_what_must_fail_a_device_and_what_need_not(call, registry):
    fails = {
        "all": ("toy", "second", "skewed", "needy"),
        "most": ("second", "skewed", "needy"),
        "few": ("toy",),
        "none": (),
    }
    entries = tuple(DeviceEntry(name, "toy", failed) for name, failed in fails.items())
    registry.kinds["fake"] = replace(registry.kinds["fake"], entries=lambda: entries)
    words = call("list").stdout.partition("Devices")[2].split()
    assert " ".join(words[2:]) == (
        "fake:all toy must fail every check fake:most toy must fail every check but toy "
        "fake:few toy must fail toy fake:none toy"
    )


def test_explain_prints_clause_derivation_floor_and_the_devices_that_must_fail(call):
    answer = call("explain", "toy")
    for text in ("Clause: Toy 1.2", "by hand", "the road", "Must fail: fake:bad"):
        assert text in answer.stdout
    assert "Must fail: no device yet" in call("explain", "second").stdout
    assert "Needs: gnss" in call("explain", "needy").stdout


def test_explain_counts_the_seeded_cases_of_each_effort(call, registry, toy_check):
    class Growing(toy_check):
        def cases(self, seed, effort):
            return super().cases(seed, effort)[: 1 if effort is Effort.QUICK else None]

    registry.checks["toy"] = Growing(count=7)
    assert "Cases: 1 at effort quick, 7 at effort certification" in call("explain", "toy").stdout


@pytest.mark.parametrize(("id_", "said"), [("nonsense", "unknown check"), ("stop", "not built")])
def test_explain_refuses_a_check_that_cannot_be_run(call, id_, said):
    answer = call("explain", id_)
    assert answer.exit_code == 2
    assert said in answer.stderr


@pytest.mark.parametrize("id_", load_registry().checks)
def test_every_check_of_the_suite_is_explained_with_a_limit_for_each_class(id_):
    check = load_registry().checks[id_]
    answer = CliRunner().invoke(main, ["explain", id_])
    assert answer.exit_code == 0
    for text in (f"{id_}: {check.title}", f"Clause: {check.clause}"):
        assert text in answer.stdout
    assert check.limits
    for quantity, limits in check.limits.items():
        (row,) = (line for line in answer.stdout.splitlines() if line.startswith(f"  {quantity}: "))
        assert all(f"{c} {limits[c]}" in row for c in DeviceClass)
