"""A device is tried on a check: the first case that it fails is told."""

import pytest

from floatref_conformance.classes import DeviceClass
from floatref_conformance.mutants import MUTATIONS
from floatref_conformance.mutants.device import Mutant
from floatref_conformance.registry import Registry
from floatref_conformance.selftest import trying
from floatref_conformance.selftest.trying import Try, attempt, try_all


@pytest.fixture
def registered(monkeypatch, toy_check):
    """Return a function that has ``device`` and the toy check, perhaps ``skew``ed, registered."""

    def register(device, **settings):
        registry = Registry({}, {"toy": toy_check(**settings)})
        monkeypatch.setattr(Registry, "device", lambda self, spec: device)
        monkeypatch.setattr(trying, "_registry", lambda edition: registry)
        return device

    return register


def test_a_sound_device_fails_nothing_and_the_search_is_part_of_it(registered, fake_device):
    device = registered(fake_device())
    assert attempt(Try("fake:device", "toy", 0)).fails == ""
    assert len(device.seen) == 2 + 3
    assert device.closed == 1


def test_the_first_case_that_fails_is_the_last(registered, halving):
    device = registered(halving)
    assert attempt(Try("fake:device", "toy", 0)).fails.startswith("toy-1: IRI error")
    assert len(device.seen) == 1


def test_the_class_decides(registered, fake_device):
    registered(fake_device(lambda t: {name: 0.98 * z for name, z in t.items()}))
    nominal, reference = (
        attempt(Try("fake:device", "toy", 0, c)).fails
        for c in (DeviceClass.NOMINAL, DeviceClass.REFERENCE)
    )
    assert nominal == ""
    assert reference


def test_without_a_class_it_is_the_one_that_the_device_claims(registered, fake_device):
    device = registered(fake_device(lambda t: {name: 0.98 * z for name, z in t.items()}))
    assert attempt(Try("fake:device", "toy", 0)).fails == ""
    device.claims = DeviceClass.REFERENCE
    assert "limit 0.01 m/km" in attempt(Try("fake:device", "toy", 0)).fails
    assert attempt(Try("fake:device", "toy", 0, DeviceClass.NOMINAL)).fails == ""


def test_mutants_claim_the_class_of_their_mutation():
    devices = {m.name: (Mutant(m), m.claims) for m in MUTATIONS}
    assert all(device.claims is claimed for device, claimed in devices.values())
    assert devices["slip-believed"][0].claims is DeviceClass.ADEQUATE
    assert devices["tilt-ignored"][0].claims is DeviceClass.NOMINAL


@pytest.mark.parametrize(
    ("edition", "ends_early"), [("2026.1", "the recording goes"), ("2026.2", "")]
)
def test_a_try_is_of_its_edition(monkeypatch, toy_check, fake_device, edition, ends_early):
    asked = []
    registry = Registry({}, {"toy": toy_check()})
    device = fake_device(lambda tracks: {t: z[:-5] for t, z in tracks.items()})
    monkeypatch.setattr(Registry, "device", lambda self, spec: device)
    monkeypatch.setattr(trying, "_registry", lambda name: asked.append(name) or registry)
    fails = attempt(Try("fake:device", "toy", 0, edition=edition)).fails
    assert ends_early in fails
    assert bool(fails) is bool(ends_early)
    assert asked == [edition]


def test_a_device_that_cannot_describe_itself_fails(registered, fake_device):
    registered(fake_device(said={"name": "nobody"}))
    assert "without a version" in attempt(Try("fake:device", "toy", 0)).fails


@pytest.mark.slow
def test_one_process_tries_in_order(registered, fake_device):
    registered(fake_device())
    tries = tuple(Try("fake:device", "toy", seed) for seed in range(3))
    assert [done.tried for done in try_all(tries, 1)] == list(tries)


@pytest.mark.slow
def test_several_processes_try_the_same():
    tries = tuple(Try(f"mutant:{name}", "quiescent", 0) for name in ("all-zeros", "tilt-ignored"))
    done = {one.tried.spec: bool(one.fails) for one in try_all(tries, 2)}
    assert done == {"mutant:all-zeros": True, "mutant:tilt-ignored": False}
