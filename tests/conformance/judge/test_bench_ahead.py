"""Recordings made ahead are the same recordings, and errors arrive where they are asked for."""

import threading
from types import SimpleNamespace

import pytest

from floatref.errors import InputError
from floatref_conformance.checks.case import Case
from floatref_conformance.devices.interface import Description
from floatref_conformance.judge import bench
from floatref_conformance.proving_ground.scenario import Scenario

DEVICE = Description("d", "1", "temporal", ())
SCENARIOS = [Scenario(seed=n, imu=False, gnss=False, response=False) for n in range(6)]


@pytest.fixture
def made(monkeypatch):
    """Return what is made, by whom; making scenario 5 is refused."""
    log = []

    def taken_of(scenario):
        log.append((scenario.seed, threading.current_thread().name))
        if scenario.seed == 5:
            raise InputError("no such drive")
        return SimpleNamespace(scenario=scenario)

    monkeypatch.setattr(bench, "make_taken", taken_of)
    return log


@pytest.fixture
def worker():
    one = bench.Ahead(DEVICE)
    yield one
    one.close()


def test_each_is_made_once_whoever_makes_it(worker, made):
    worker.announce(Case("toy", scenario) for scenario in SCENARIOS[:5])
    worker.announce(Case("toy", scenario) for scenario in SCENARIOS[:5])
    assert [worker(scenario).scenario for scenario in SCENARIOS[:5]] == SCENARIOS[:5]
    assert sorted(seed for seed, _ in made) == [0, 1, 2, 3, 4]


def test_the_channels_are_those_of_the_device(worker, made):
    worker.announce([Case("toy", Scenario(seed=1))])
    assert worker(SCENARIOS[1]).scenario == SCENARIOS[1]
    assert len(made) == 1


def test_what_was_not_announced_is_made_at_once(worker, made):
    assert worker(SCENARIOS[0]).scenario == SCENARIOS[0]
    assert made == [(0, threading.current_thread().name)]


def test_what_waits_for_its_turn_is_made_by_the_one_who_asks(worker, made):
    gate = threading.Event()
    worker._worker.submit(gate.wait)
    worker.announce([Case("toy", SCENARIOS[2])])
    assert worker(SCENARIOS[2]).scenario == SCENARIOS[2]
    gate.set()
    assert made == [(2, threading.current_thread().name)]


@pytest.mark.parametrize("asked", [0, 1, 7])
def test_few_wait_to_be_asked_for_and_the_next_follow(worker, made, asked):
    """One task at a time is done, so that after another one all that was begun is made."""
    many = [Scenario(seed=10 + n, imu=False, gnss=False, response=False) for n in range(12)]
    worker.announce(Case("toy", scenario) for scenario in many)
    for scenario in many[:asked]:
        assert worker(scenario).scenario == scenario
    worker._worker.submit(int).result()
    assert {seed for seed, _ in made} == set(range(10, 10 + asked + bench.OUTSTANDING))


def test_what_is_never_asked_for_makes_room(worker, made):
    many = [Scenario(seed=10 + n, imu=False, gnss=False, response=False) for n in range(12)]
    worker.announce(Case("toy", scenario) for scenario in many)
    assert worker(many[5]).scenario == many[5]
    worker._worker.submit(int).result()
    begun = {seed for seed, _ in made}
    assert begun - {10, 11, 12} == {15, 16, 17, 18}
    assert worker(many[0]).scenario == many[0]


def test_an_error_is_that_of_asking(worker, made):
    worker.announce([Case("toy", SCENARIOS[5])])
    with pytest.raises(InputError, match="no such drive"):
        worker(SCENARIOS[5])


def test_nothing_runs_on_after_closing(made):
    worker = bench.Ahead(DEVICE)
    worker.announce(Case("toy", scenario) for scenario in SCENARIOS[:5])
    worker.close()
    assert not [t for t in threading.enumerate() if t.name.startswith("simulating-ahead")]
