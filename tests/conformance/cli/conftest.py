"""The `conformance` command with toy checks and devices in place of all."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from floatref.errors import InputError
from floatref_conformance import EDITION
from floatref_conformance.case_files import document
from floatref_conformance.checks.case import Case
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli import explain, judging_options, replay, run
from floatref_conformance.cli import list as listing
from floatref_conformance.cli.main import main
from floatref_conformance.devices.interface import DeviceEntry, DeviceKind
from floatref_conformance.errors import DeviceError, DeviceSkipped
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.registry import Registry

MODULES = (explain, listing, replay, run)
SPOILED = {
    "good": lambda z: z,
    "bad": lambda z: 0.5 * z,
    "low": lambda z: 0.98 * z,
    "clipping": lambda z: np.clip(z, -0.004, 0.004),
}


@pytest.fixture
def devices(fake_device, raising):
    """Devices by name; what they become during a command can be looked at afterwards."""
    made = {
        name: fake_device(lambda tracks, spoil=spoil: {t: spoil(z) for t, z in tracks.items()})
        for name, spoil in SPOILED.items()
    }
    made["clipping"].searchable = False
    made["low"].claims = "adequate"
    made["low"].timeout_s = None
    made["choosy"] = raising(DeviceSkipped("too fast for me"))
    made["broken"] = raising(DeviceError("out of paper"))
    return made


@pytest.fixture
def registry(toy_check, devices):
    """Checks that pass a good device, one that measures wrongly, and one that needs GNSS."""

    def make(name):
        if name == "odd":
            raise ZeroDivisionError("out of luck")
        if name not in devices:
            raise InputError(f"device fake:{name}: unknown; known: {', '.join(devices)}")
        return devices[name]

    entries = tuple(DeviceEntry(name, "toy", ("toy",) * (name == "bad")) for name in devices)
    kinds = {"fake": DeviceKind("fake", "NAME", make, lambda: entries)}
    skewed, needy = toy_check(id="skewed", skew=0.1), toy_check(id="needy", needs={"gnss"})
    checks = {c.id: c for c in (toy_check(), toy_check(id="second"), skewed, needy)}
    return Registry(kinds, checks, ("plug-in sad: ImportError: gone; it is left out",))


@pytest.fixture
def call(monkeypatch, registry):
    for module in MODULES:
        monkeypatch.setattr(module, "load_registry", lambda edition: registry)
    # The probes are drives of the proving ground, which say nothing of a toy.
    monkeypatch.setattr(judging_options, "add_resemblance", lambda result, device: result)
    return lambda *words: CliRunner().invoke(main, [*map(str, words)])


@pytest.fixture
def run_toy(call):
    """Return a function that has a device judged by the check `toy` alone."""
    return lambda device, *words: call(
        "run", "--device", f"fake:{device}", "--check", "toy", *words
    )


@pytest.fixture
def keep():
    """Return a function that keeps a case in a folder, of a rough road unless told otherwise."""

    def make(folder, check="toy", device_class=DeviceClass.NOMINAL, edition=EDITION, **numbers):
        case = Case(check, Scenario(**{"iri_m_per_km": 6.0, **numbers}))
        path = folder / "cases" / f"{check}-1.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        content = document(case, device_class, "fake:bad", "too rough")
        path.write_text(json.dumps({**content, "edition": edition}))
        return path

    return make
